// SPDX-License-Identifier: Apache-2.0
#include <stb/stb_image_write.h>

#include "leafhull/error.h"
#include "leafhull/picture.h"

namespace leafhull {
namespace {

void append(void* file, void* bytes, int count) {
  const auto* first = static_cast<const std::uint8_t*>(bytes);
  auto& whole = *static_cast<std::vector<std::uint8_t>*>(file);
  whole.insert(whole.end(), first, first + count);
}

}  // namespace

std::vector<std::uint8_t> encode_png(const Picture& picture) {
  std::vector<std::uint8_t> file;
  if (!stbi_write_png_to_func(append, &file, picture.width, picture.height, 3, picture.rgb.data(),
                              3 * picture.width)) {
    throw Error(ErrorCode::internal, "no memory for a PNG file");
  }
  return file;
}

std::vector<std::uint8_t> encode_jpeg(const Picture& picture, int quality) {
  std::vector<std::uint8_t> file;
  if (!stbi_write_jpg_to_func(append, &file, picture.width, picture.height, 3, picture.rgb.data(),
                              quality)) {
    throw Error(ErrorCode::internal, "a picture without pixels has no JPEG file");
  }
  return file;
}

}  // namespace leafhull
