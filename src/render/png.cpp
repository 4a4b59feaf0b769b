// SPDX-License-Identifier: Apache-2.0
#include <stb/stb_image.h>
#include <stb/stb_image_write.h>

#include <climits>
#include <memory>

#include "leafhull/error.h"
#include "leafhull/picture.h"

namespace leafhull {

std::vector<std::uint8_t> encode_png(const Picture& picture) {
  std::vector<std::uint8_t> file;
  const auto append = [](void* to, void* bytes, int count) {
    const auto* first = static_cast<const std::uint8_t*>(bytes);
    auto& whole = *static_cast<std::vector<std::uint8_t>*>(to);
    whole.insert(whole.end(), first, first + count);
  };
  if (!stbi_write_png_to_func(append, &file, picture.width, picture.height, 3, picture.rgb.data(),
                              3 * picture.width)) {
    throw Error(ErrorCode::internal, "no memory for a PNG file");
  }
  return file;
}

Picture decode_png(std::span<const std::uint8_t> file) {
  Picture picture;
  const int size = file.size() > INT_MAX ? 0 : static_cast<int>(file.size());
  const std::unique_ptr<stbi_uc, void (*)(void*)> pixels(
      stbi_load_from_memory(file.data(), size, &picture.width, &picture.height, nullptr, 3),
      stbi_image_free);
  if (!pixels) throw Error(ErrorCode::input, "not a PNG picture", "Give one that is whole.");
  const auto count = 3 * static_cast<std::size_t>(picture.width) * picture.height;
  picture.rgb.assign(pixels.get(), pixels.get() + count);
  return picture;
}

}  // namespace leafhull
