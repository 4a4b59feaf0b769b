// SPDX-License-Identifier: Apache-2.0
#include "render/shade.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>

#include "render/light.h"

namespace leafhull::render {
namespace {

constexpr float kGloss = 0.16f, kShininess = 24;
constexpr float kLeastOpen = 0.22f;  // in large pictures shade keeps its colour
constexpr float kFarGrey = 0.2f;

EdgeSample centre(const Buffers& buffers, std::size_t i) {
  return {buffers.object[i], buffers.depth[i], buffers.normal[i], buffers.position[i],
          buffers.color[i],  buffers.key[i],   buffers.open[i]};
}

/// Colours every pixel, at edges with the mean of what its rays see.
template <class Color, class Encode>
Picture shade(const Buffers& buffers, Color&& color, Encode&& encode) {
  Picture picture{buffers.width, buffers.height, {}};
  picture.rgb.resize(3 * buffers.size());
  const auto put = [&](std::size_t i, Vec3f value) {
    std::uint8_t* rgb = &picture.rgb[3 * i];
    rgb[0] = encode(value.x), rgb[1] = encode(value.y), rgb[2] = encode(value.z);
  };
  tbb::parallel_for(0, buffers.height, [&](int y) {
    const std::size_t first = static_cast<std::size_t>(y) * buffers.width;
    for (std::size_t i = first; i < first + buffers.width; ++i) put(i, color(centre(buffers, i)));
  });
  tbb::parallel_for(std::size_t{0}, buffers.edges.size(), [&](std::size_t edge) {
    const std::uint32_t i = buffers.edges[edge];
    Vec3f sum = color(centre(buffers, i));
    for (int ray = 0; ray < buffers.edge_rays; ++ray) {
      sum = sum + color(buffers.samples[edge * buffers.edge_rays + ray]);
    }
    put(i, sum / static_cast<float>(1 + buffers.edge_rays));
  });
  return picture;
}

/// A value that is not a colour as 8 bits.
std::uint8_t byte(float value) {
  return static_cast<std::uint8_t>(std::lround(255 * std::clamp(value, 0.0f, 1.0f)));
}

/// The light of the sky, weaker and greener inside the crown, and of the key light.
Vec3f diffuse(const EdgeSample& at, Vec3f to_light) {
  const Vec3f sky_there =
      mix(kPaperBounce, mix(kHorizon, kZenith, 0.6f), 0.5f + 0.5f * at.normal.y);
  const Vec3f sky_light = mix(at.color * kHorizon * 0.35f, sky_there, at.open);
  const Vec3f key_light = kSun * (at.key * std::max(0.0f, dot(at.normal, to_light)));
  return at.color * (key_light + sky_light);
}

/// The key light's mirror image, blurred. Source: B. T. Phong, "Illumination for Computer Generated
/// Pictures", CACM 18(6), 1975.
Vec3f specular(const EdgeSample& at, Vec3f to_light, Vec3f eye) {
  const float facing = dot(at.normal, to_light);
  if (facing <= 0) return {};
  const float mirrored = dot(at.normal * (2 * facing) - to_light, normalized(eye - at.position));
  return kSun * (kGloss * at.key * std::pow(std::max(0.0f, mirrored), kShininess));
}

}  // namespace

Picture shade_phong(const Buffers& buffers) {
  const auto color = [&](const EdgeSample& at) {
    if (at.object == Object::paper) return kWhite;
    EdgeSample lit = at;
    lit.open = kLeastOpen + (1 - kLeastOpen) * at.open;
    return develop(diffuse(lit, buffers.to_light) + specular(at, buffers.to_light, buffers.eye));
  };
  return shade(buffers, color, srgb);
}

Picture shade_matte(const Buffers& buffers) {
  const auto color = [&](const EdgeSample& at) {
    return at.object == Object::paper ? kWhite : develop(diffuse(at, buffers.to_light));
  };
  return shade(buffers, color, srgb);
}

Picture shade_normals(const Buffers& buffers, const Camera& camera) {
  const auto color = [&](const EdgeSample& at) {
    const Vec3f n{dot(at.normal, camera.right), dot(at.normal, camera.up),
                  -dot(at.normal, camera.forward)};
    return n * 0.5f + Vec3f{0.5f, 0.5f, 0.5f};
  };
  return shade(buffers, color, byte);
}

Picture shade_depth(const Buffers& buffers) {
  float nearest = HUGE_VALF, farthest = 0;
  const auto include = [&](float depth) {
    if (depth == HUGE_VALF) return;
    nearest = std::min(nearest, depth), farthest = std::max(farthest, depth);
  };
  for (const float depth : buffers.depth) include(depth);
  for (const EdgeSample& sample : buffers.samples) include(sample.depth);
  const float range = std::max(farthest - nearest, 1e-6f);
  const auto color = [&](const EdgeSample& at) {
    if (at.object == Object::paper) return Vec3f{};
    return kWhite * (1 - (1 - kFarGrey) * (at.depth - nearest) / range);
  };
  return shade(buffers, color, byte);
}

}  // namespace leafhull::render
