// SPDX-License-Identifier: Apache-2.0
#include <stb/stb_image.h>

#include <climits>
#include <memory>

#include "leafhull/error.h"
#include "leafhull/picture.h"

namespace leafhull {

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
