// SPDX-License-Identifier: Apache-2.0
#include "input/images.h"

#include <stb/stb_image.h>

#include <climits>
#include <cstdint>
#include <memory>
#include <string_view>

namespace leafhull {
namespace {

// A few bytes can claim any size; this is 256 MiB decoded.
constexpr std::int64_t kMostPixels = 8192 * 8192;

// stb_image's readers of rarer formats are not meant for files from strangers.
bool is_accepted_format(ByteSpan bytes, std::string_view name) {
  const std::string_view text = text_of(bytes);
  return text.starts_with("\x89PNG") || text.starts_with("\xFF\xD8\xFF") ||
         text.starts_with("BM") || name.ends_with(".tga") || name.ends_with(".TGA");
}

}  // namespace

Image decode_image(ByteSpan bytes, const std::string& name, std::string& reason) {
  if (bytes.size() > INT_MAX || !is_accepted_format(bytes, name)) {
    reason = "it is not a PNG or JPEG image";
    return {};
  }
  Image image;
  const int length = static_cast<int>(bytes.size());
  int channels = 0;
  if (!stbi_info_from_memory(bytes.data(), length, &image.width, &image.height, &channels)) {
    reason = stbi_failure_reason();
    return {};
  }
  const std::int64_t pixels = static_cast<std::int64_t>(image.width) * image.height;
  if (pixels > kMostPixels) {
    reason = "it is larger than 8192 x 8192 pixels";
    return {};
  }
  const std::unique_ptr<stbi_uc, void (*)(void*)> rgba(
      stbi_load_from_memory(bytes.data(), length, &image.width, &image.height, &channels, 4),
      &stbi_image_free);
  if (!rgba) {
    reason = stbi_failure_reason();
    return {};
  }
  image.rgba.assign(rgba.get(), rgba.get() + pixels * 4);
  return image;
}

}  // namespace leafhull
