// SPDX-License-Identifier: Apache-2.0
#include "scene/height_field.h"

#include <stb/stb_image.h>

#include <algorithm>
#include <climits>
#include <cmath>
#include <memory>

#include "input/file_bytes.h"
#include "leafhull/error.h"
#include "text/text.h"

namespace leafhull {
namespace {

constexpr std::int64_t kMostPixels = 16384 * 16384;  // 512 MiB

[[noreturn]] void fail(const std::filesystem::path& picture, const std::string& what) {
  throw Error(ErrorCode::input, "the height map " + printable(picture.string(), 1000) + ' ' + what,
              "Give a grey PNG of 8 or 16 bits, of up to 16384 x 16384 pixels.");
}

Bytes read_picture(const std::filesystem::path& picture) try {
  return read_file(picture, Pipes::read);
} catch (const FileError& error) {
  fail(picture, std::string("cannot be read: ") + error.what());
}

}  // namespace

HeightField::HeightField(const HeightMap& map) : height_(map.height) {
  const Bytes bytes = read_picture(map.picture);
  if (!text_of(bytes).starts_with("\x89PNG")) fail(map.picture, "is not a PNG picture");
  const int size = bytes.size() > INT_MAX ? 0 : static_cast<int>(bytes.size());
  if (stbi_info_from_memory(bytes.data(), size, &width_, &rows_, nullptr) == 0 ||
      std::int64_t{width_} * rows_ > kMostPixels) {
    fail(map.picture, "is damaged or too large");
  }
  const std::unique_ptr<stbi_us, void (*)(void*)> pixels(
      stbi_load_16_from_memory(bytes.data(), size, &width_, &rows_, nullptr, 1), &stbi_image_free);
  if (!pixels) fail(map.picture, "is damaged: " + printable(stbi_failure_reason()));
  grey_.assign(pixels.get(), pixels.get() + static_cast<std::size_t>(width_) * rows_);
}

double HeightField::at(double u, double v) const {
  const double x = u * (width_ - 1), y = v * (rows_ - 1);
  const int left = static_cast<int>(x), top = static_cast<int>(y);
  const int right = std::min(left + 1, width_ - 1), bottom = std::min(top + 1, rows_ - 1);
  const auto grey = [&](int column, int row) {
    return static_cast<double>(grey_[static_cast<std::size_t>(row) * width_ + column]);
  };
  const double upper = std::lerp(grey(left, top), grey(right, top), x - left);
  const double lower = std::lerp(grey(left, bottom), grey(right, bottom), x - left);
  return height_ * std::lerp(upper, lower, y - top) / 65535;
}

}  // namespace leafhull
