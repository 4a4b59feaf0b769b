// SPDX-License-Identifier: Apache-2.0
#include "render/mesh_target.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <optional>

#include "render/for_each.h"
#include "render/light.h"
#include "render/sampling.h"

namespace leafhull::render {
namespace {

constexpr std::size_t kRays = 64;  // rays that one thread takes at a time

Spot spot_of(const Hit& hit) {
  return {hit.distance,    hit.surface->look == Look::wood ? Object::wood : Object::foliage,
          hit.position,    hit.normal,
          hit.face_normal, hit.color};
}

}  // namespace

void MeshTarget::closest(std::span<const Ray> rays, std::span<Spot> spots) const {
  constexpr std::size_t kPacket = Scene::kPacket;
  tbb::parallel_for(std::size_t{0}, (rays.size() + kPacket - 1) / kPacket, [&](std::size_t packet) {
    const std::size_t first = packet * kPacket, count = std::min(kPacket, rays.size() - first);
    std::array<std::optional<Hit>, kPacket> hits;
    scene_.closest(rays.subspan(first, count), std::span(hits).first(count));
    for (std::size_t i = 0; i < count; ++i) {
      spots[first + i] = hits[i] ? spot_of(*hits[i]) : Spot{};
    }
  });
}

void MeshTarget::occluded(std::span<const Ray> rays, float reach,
                          std::span<std::uint8_t> answers) const {
  for_each(rays.size(), kRays, [&](std::size_t i) {
    answers[i] = scene_.occluded(rays[i].origin, rays[i].direction, reach);
  });
}

void MeshSurroundings::openness(std::span<const Spot> spots, std::span<const std::uint8_t> turns,
                                std::span<float> open) const {
  const std::vector<Vec2f> directions = sobol_points(kTurns, 2);
  std::vector<Vec3f> towards(spots.size());
  for_each(spots.size(), kRays, [&](std::size_t i) {
    if (spots[i].hit()) towards[i] = cosine_direction(spots[i].normal, directions[turns[i]]);
  });
  std::vector<Ray> rays;
  std::vector<std::size_t> asked;
  for (std::size_t i = 0; i < spots.size(); ++i) {
    open[i] = 0;
    if (!(dot(towards[i], spots[i].face_normal) > 0)) continue;
    rays.push_back({spots[i].start, towards[i]});
    asked.push_back(i);
  }
  const std::vector<std::uint8_t> hidden = render::occluded(targets_, rays, kSkyReach);
  for (std::size_t i = 0; i < asked.size(); ++i) open[asked[i]] = hidden[i] ? 0 : 1;
}

std::vector<std::uint8_t> occluded(std::span<const Target* const> targets,
                                   std::span<const Ray> rays, float reach) {
  std::vector<std::uint8_t> any(rays.size()), answers(rays.size());
  for (const Target* target : targets) {
    target->occluded(rays, reach, answers);
    for (std::size_t i = 0; i < rays.size(); ++i) any[i] |= answers[i];
  }
  return any;
}

}  // namespace leafhull::render
