// SPDX-License-Identifier: Apache-2.0
#include "watercolour/tones.h"

#include <cstddef>

#include "colour/colour.h"
#include "render/light.h"

namespace leafhull::watercolour {
namespace {

constexpr double kSame = 0.01;  // a negligible distance in Oklab's plane of hues

/// How much a colour is like a tone; the fourth power of the distance separates tones sharply.
double likeness(Vec3d lab, Vec3d tone) {
  const double a = lab.y - tone.y, b = lab.z - tone.z;
  const double squared = a * a + b * b + kSame * kSame;
  return 1 / (squared * squared);
}

}  // namespace

Weights weigh_tones(const render::Buffers& buffers, std::span<const Vec3f> tones) {
  std::vector<Vec3d> labs;
  for (const Vec3f tone : tones) labs.push_back(oklab_of(render::foliage_colour(tone)));
  Weights weights;
  weights.seen.resize(buffers.size());
  weights.others.resize(buffers.size());
  weights.other.assign(tones.size() - 1, std::vector<float>(buffers.size()));
  std::vector<double> like(tones.size());
  for (std::size_t pixel = 0; pixel < buffers.size(); ++pixel) {
    if (buffers.object[pixel] != render::Object::foliage) continue;
    weights.seen[pixel] = 1;
    const Vec3d lab = oklab_of(buffers.color[pixel]);
    double sum = 0;
    for (std::size_t i = 0; i < labs.size(); ++i) sum += like[i] = likeness(lab, labs[i]);
    for (std::size_t i = 1; i < labs.size(); ++i) {
      const auto weight = static_cast<float>(like[i] / sum);
      weights.other[i - 1][pixel] = weight;
      weights.others[pixel] += weight;
    }
  }
  return weights;
}

}  // namespace leafhull::watercolour
