// SPDX-License-Identifier: Apache-2.0
#include <stb/stb_image.h>
#include <stb/stb_image_write.h>

#include <climits>
#include <limits>
#include <memory>

#include "leafhull/error.h"
#include "leafhull/picture.h"

namespace leafhull {
namespace {

void append(void* file, void* bytes, int count) {
  const auto* first = static_cast<const std::uint8_t*>(bytes);
  auto& whole = *static_cast<std::vector<std::uint8_t>*>(file);
  whole.insert(whole.end(), first, first + count);
}

/// stb counts bytes in an int.
void check_size(const Picture& picture, int more_per_row, const char* format) {
  const std::int64_t row = 3 * std::int64_t{picture.width} + more_per_row;
  if (row * picture.height <= std::numeric_limits<int>::max()) return;
  throw Error(ErrorCode::usage,
              "a picture of " + std::to_string(picture.width) + "x" +
                  std::to_string(picture.height) + " pixels is too large for a " + format + " file",
              "Ask for a smaller picture.");
}

}  // namespace

std::vector<std::uint8_t> encode_png(const Picture& picture) {
  check_size(picture, 1, "PNG");  // a row begins with its filter
  std::vector<std::uint8_t> file;
  if (!stbi_write_png_to_func(append, &file, picture.width, picture.height, 3, picture.rgb.data(),
                              3 * picture.width)) {
    throw Error(ErrorCode::internal, "no memory for a PNG file");
  }
  return file;
}

std::vector<std::uint8_t> encode_jpeg(const Picture& picture, int quality) {
  check_size(picture, 0, "JPEG");
  std::vector<std::uint8_t> file;
  if (!stbi_write_jpg_to_func(append, &file, picture.width, picture.height, 3, picture.rgb.data(),
                              quality)) {
    throw Error(ErrorCode::internal, "a picture without pixels has no JPEG file");
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
