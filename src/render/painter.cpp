// SPDX-License-Identifier: Apache-2.0
#include "render/painter.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>

#include "render/light.h"
#include "render/sampling.h"

namespace leafhull::render {
namespace {

constexpr Vec3f kThroughLeaf{0.95f, 0.85f, 0.35f};
constexpr Vec3f kShadow{0.60f, 0.62f, 0.70f};  // the darkest the paper gets
constexpr int kSkyRays = 2;                    // per sample

float luminance(Vec3f c) { return 0.2126f * c.x + 0.7152f * c.y + 0.0722f * c.z; }

/// From 0 at `zero` to 1 at `one`.
float smoothstep(float zero, float one, float x) {
  const float t = std::clamp((x - zero) / (one - zero), 0.0f, 1.0f);
  return t * t * (3 - 2 * t);
}

/// The random numbers of one sample of one pixel.
struct Sample {
  std::uint32_t pixel, index;
  enum Use : std::uint32_t { lens, sun, sky };

  Vec2f at(Use use, std::uint32_t count = 1, std::uint32_t i = 0) const {
    return sobol(index * count + i, hash(pixel * 4 + use));
  }
};

class Painter {
 public:
  Painter(const Scene& scene, const Camera& camera)
      : scene_(scene),
        camera_(camera),
        sun_(sun_direction(camera)),
        paper_reach_(length(camera.eye) * camera.tan_x) {}

  Vec3f color(float x, float y, const Sample& sample) const {
    const Vec3f direction = camera_.direction(x, y);
    if (const auto hit = scene_.closest(camera_.eye, direction)) {
      return develop(shade(*hit, sample));
    }
    if (direction.y >= 0) return kWhite;
    const Vec3f foot = camera_.eye - direction * (camera_.eye.y / direction.y);
    const float fade = smoothstep(1, 0.3f, length(foot) / paper_reach_) * smoothstep(1, 0.93f, y);
    return fade > 0 ? mix(kWhite, kShadow, fade * ground_shadow(foot, sample)) : kWhite;
  }

 private:
  Vec3f shade(const Hit& hit, const Sample& sample) const {
    const Vec3f sun = normalized(on_disk(sun_, sample.at(Sample::sun), kSunRadius));
    const Vec3f color = painted(hit);
    const Vec3f taken = sun_taken(hit, sun);
    Vec3f light;
    if (taken != Vec3f{} && !scene_.occluded(hit.position, sun, HUGE_VALF)) light = kSun * taken;
    for (int i = 0; i < kSkyRays; ++i) {
      const Vec3f ray = cosine_direction(hit.normal, sample.at(Sample::sky, kSkyRays, i));
      const bool open =
          dot(ray, hit.face_normal) > 0 && !scene_.occluded(hit.position, ray, kSkyReach);
      // What shades a surface throws back some of its own light.
      light = light + (open ? sky(ray) : color * kHorizon * 0.35f) * (1.0f / kSkyRays);
    }
    return color * light;
  }

  static Vec3f painted(const Hit& hit) {
    const Vec3f color = hit.color;
    if (hit.surface->look == Look::shape) return color;
    if (hit.surface->look == Look::wood) return color * 0.75f;
    return color * (0.42f / (0.2f + luminance(color)));  // exporters' greens differ
  }

  /// The part of the sun's light that goes on to the eye. A leaf scatters it both ways, yellower
  /// through it.
  static Vec3f sun_taken(const Hit& hit, Vec3f sun) {
    const float cosine = dot(hit.normal, sun);
    if (hit.surface->look != Look::leaf) return kWhite * std::max(cosine, 0.0f);
    return cosine > 0 ? kWhite * (0.3f + 0.7f * cosine) : kThroughLeaf * (0.3f - 0.7f * cosine);
  }

  /// The shadow on the paper around the foot, 0..1.
  float ground_shadow(Vec3f position, const Sample& sample) const {
    const Vec3f sun = normalized(on_disk(sun_, sample.at(Sample::sun), kSunRadius));
    float shadow = scene_.occluded(position, sun, HUGE_VALF) ? 0.45f : 0;
    for (int i = 0; i < kSkyRays; ++i) {
      const Vec3f ray = cosine_direction({0, 1, 0}, sample.at(Sample::sky, kSkyRays, i));
      if (scene_.occluded(position, ray, HUGE_VALF)) shadow += 0.55f / kSkyRays;
    }
    return shadow;
  }

  const Scene& scene_;
  const Camera& camera_;
  Vec3f sun_;
  float paper_reach_;  ///< where the ground's shadow has faded to white
};

}  // namespace

void draw(const Scene& scene, const Camera& camera, int samples, int left, int width,
          Picture& picture) {
  const Painter painter(scene, camera);
  tbb::parallel_for(0, picture.height, [&](int row) {
    for (int column = 0; column < width; ++column) {
      const std::uint32_t pixel = row * picture.width + left + column;
      Vec3f sum{};
      for (int i = 0; i < samples; ++i) {
        const Sample sample{pixel, static_cast<std::uint32_t>(i)};
        const Vec2f lens = sample.at(Sample::lens);
        sum =
            sum + painter.color((column + lens.x) / width, (row + lens.y) / picture.height, sample);
      }
      std::uint8_t* rgb = &picture.rgb[std::size_t{3} * pixel];
      rgb[0] = srgb(sum.x / samples), rgb[1] = srgb(sum.y / samples),
      rgb[2] = srgb(sum.z / samples);
    }
  });
}

}  // namespace leafhull::render
