// SPDX-License-Identifier: Apache-2.0
#include "picture/check_picture.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "leafhull/error.h"
#include "pipeline/memory.h"
#include "text/numbers.h"

namespace leafhull {
namespace {

// Bytes per pixel, measured at 2048x2048 and 4096x4096. On the host, 70 are for what pixels see, 60
// for an .exr file, the rest for edges; on the device, 150 are for the planes of a watercolour.
constexpr double kHostBytes = 160, kPaintBytes = 160;

/// @throws Error usage: `bytes` per pixel are more than are `available`.
void check_available(const PictureOptions& options, double bytes, double available,
                     const std::string& of) {
  const double needed = bytes * options.width * options.height;
  if (needed <= available) return;
  constexpr double kGiB = 1 << 30;
  constexpr double kToSpare = 0.98;  // what is available changes from run to run
  const double shrink = std::sqrt(kToSpare * available / needed);
  const auto side = [&](int full) { return std::max(1, static_cast<int>(full * shrink)); };
  const std::string largest = size_text(side(options.width), side(options.height));
  throw Error(
      ErrorCode::usage,
      "a picture of " + size_text(options.width, options.height) + " pixels needs about " +
          significant(needed / kGiB, 3) + " GiB, and " + significant(available / kGiB, 3) + " GiB" +
          of + " are available",
      "The largest of this shape that fits is about " + largest + " (--size " + largest + ").");
}

}  // namespace

std::string size_text(int width, int height) {
  return std::to_string(width) + "x" + std::to_string(height);
}

void check_sides(const PictureOptions& options) {
  const int least = std::min(options.width, options.height);
  const int most = std::max(options.width, options.height);
  if (least < 1 || most > kLargestSide) {
    throw Error(
        ErrorCode::usage,
        "a picture of " + size_text(options.width, options.height) + " pixels is out of range",
        "Give 1 to " + std::to_string(kLargestSide) + " pixels along each side.");
  }
}

void check_memory(const PictureOptions& options, const DeviceInfo* device, double kept) {
  const bool paints = options.look == Look::watercolour && device;
  const bool shared = device && device->type == "CPU";
  const auto host = static_cast<double>(available_memory());
  check_available(options, kept + kHostBytes + (paints && shared ? kPaintBytes : 0), host, "");
  if (!paints || shared) return;
  check_available(options, kPaintBytes, static_cast<double>(device->memory_bytes),
                  " of the device's memory");
}

void check_picture(const PictureOptions& options, const DeviceInfo* device) {
  check_sides(options);
  check_memory(options, device, 0);
}

}  // namespace leafhull
