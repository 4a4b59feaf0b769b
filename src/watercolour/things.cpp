// SPDX-License-Identifier: Apache-2.0
#include "watercolour/things.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

#include "colour/colour.h"

namespace leafhull::watercolour {
namespace {

/// Where sectors of hue begin, degrees. Hues before the first, such as bark, and greys are wood.
constexpr std::array<double, 6> kSectors{50, 80, 165, 200, 260, 330};
constexpr double kGrey = 0.2;  // saturation
constexpr double kChroma = 0.8;

constexpr std::size_t kWood = 0;

std::size_t sector_of(Vec3f linear) {
  const Hsv hsv = hsv_of(linear);
  if (hsv.saturation < kGrey || hsv.hue >= 350) return kWood;
  return static_cast<std::size_t>(std::ranges::upper_bound(kSectors, hsv.hue) - kSectors.begin());
}

/// The index of the pixel if it shows wood, else of a neighbour that does, else of the pixel.
std::size_t seen_at(const render::Buffers& buffers, int x, int y) {
  const auto at = [&](int i, int j) {
    return static_cast<std::size_t>(j) * static_cast<std::size_t>(buffers.width) +
           static_cast<std::size_t>(i);
  };
  if (buffers.object[at(x, y)] == render::Object::wood) return at(x, y);
  for (int j = std::max(y - 1, 0); j <= std::min(y + 1, buffers.height - 1); ++j) {
    for (int i = std::max(x - 1, 0); i <= std::min(x + 1, buffers.width - 1); ++i) {
      if (buffers.object[at(i, j)] == render::Object::wood) return at(i, j);
    }
  }
  return at(x, y);
}

}  // namespace

std::vector<Thing> things_of(const render::Buffers& buffers) {
  std::array<Thing, kSectors.size() + 1> sectors;
  std::array<Vec3d, sectors.size()> sums;
  std::array<double, sectors.size()> weights{};
  sectors[kWood].coverage.resize(buffers.size());
  for (int y = 0; y < buffers.height; ++y) {
    for (int x = 0; x < buffers.width; ++x) {
      const std::size_t pixel =
          static_cast<std::size_t>(y) * static_cast<std::size_t>(buffers.width) +
          static_cast<std::size_t>(x);
      const float covered = buffers.wood[pixel];
      if (!(covered > 0)) continue;
      const std::size_t seen = seen_at(buffers, x, y);
      const bool is_known = buffers.object[seen] == render::Object::wood;
      const std::size_t sector = is_known ? sector_of(buffers.color[seen]) : kWood;
      Thing& thing = sectors[sector];
      thing.coverage.resize(buffers.size());
      thing.coverage[pixel] = covered;
      sums[sector] = sums[sector] + Vec3d(buffers.color[seen]) * double{covered};
      weights[sector] += double{covered};
    }
  }
  std::vector<Thing> things;
  for (std::size_t i = 0; i < sectors.size(); ++i) {
    if (i != kWood && sectors[i].coverage.empty()) continue;
    if (i != kWood) sectors[i].colour = Vec3f(sums[i] / weights[i]);
    things.push_back(std::move(sectors[i]));
  }
  return things;
}

Wash hued(Wash wash, Vec3f linear) {
  const Vec3d wanted = oklab_of(linear);
  const double chroma = std::hypot(wanted.y, wanted.z);
  if (!(chroma > 0)) return wash;
  for (Vec3f* pigment : {&wash.cool, &wash.warm}) {
    const Vec3d lab = oklab_of_srgb(*pigment);
    const double of_pigment = std::max(std::hypot(lab.y, lab.z), kChroma * chroma);
    *pigment = shown_srgb({lab.x, of_pigment * wanted.y / chroma, of_pigment * wanted.z / chroma});
  }
  return wash;
}

}  // namespace leafhull::watercolour
