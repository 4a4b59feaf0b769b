// SPDX-License-Identifier: Apache-2.0
#include "watercolour/foot.h"

#include <algorithm>

namespace leafhull::watercolour {
namespace {

constexpr float kSteep = 0.6f;  // if the camera looks down more, the ground is no longer a strip
constexpr int kPart = 50;       // the foot is searched in 1 / kPart of the picture's height

}  // namespace

std::optional<Foot> find_foot(const render::Buffers& buffers) {
  if (buffers.to_eye.y > kSteep) return std::nullopt;
  const int width = buffers.width, height = buffers.height;
  int lowest = -1, lowest_wood = -1, left = width, right = -1;
  double count = 0, sum = 0;
  for (int y = height - 1; y >= 0; --y) {
    for (int x = 0; x < width; ++x) {
      const render::Object object = buffers.object[static_cast<std::size_t>(y) * width + x];
      if (object == render::Object::paper) continue;
      lowest = std::max(lowest, y);
      left = std::min(left, x), right = std::max(right, x);
      if (object != render::Object::wood) continue;
      lowest_wood = std::max(lowest_wood, y);
      if (y < lowest_wood - height / kPart) continue;
      count += 1, sum += x + 0.5;
    }
  }
  const bool stands = lowest_wood >= 0 && lowest_wood >= lowest - height / kPart;
  const bool cut_off = lowest_wood == height - 1;
  if (!stands || cut_off) return std::nullopt;
  return Foot{static_cast<float>(sum / count), static_cast<float>(lowest_wood),
              0.5f * static_cast<float>(right - left + 1)};
}

}  // namespace leafhull::watercolour
