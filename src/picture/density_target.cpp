// SPDX-License-Identifier: Apache-2.0
#include "picture/density_target.h"

#include <tbb/parallel_for.h>

#include <vector>

#include "render/light.h"
#include "render/sampling.h"

namespace leafhull {
namespace {

/// Rays to the light start this far above the surface, voxels. There the trilinear N, which is only
/// an estimate, is outside the surface too.
constexpr float kLift = 1.5f;
/// How far N exceeds T where a shadow is full, as a share of T.
constexpr float kHard = 1e-6f;

}  // namespace

DensityTarget::DensityTarget(std::shared_ptr<const DirectSurface> surface,
                             const render::Placement& placement, Vec3f color)
    : surface_(std::move(surface)),
      origin_(surface_->lattice().local(placement.origin)),
      voxels_(1 / (placement.scale * surface_->lattice().voxel_size)),
      color_(color) {}

VoxelRay DensityTarget::in_voxels(Vec3f position, Vec3f direction) const {
  return {Vec3f(Vec3d(position) * voxels_ + origin_), direction};
}

std::vector<VoxelRay> DensityTarget::in_voxels(std::span<const render::Ray> rays) const {
  std::vector<VoxelRay> voxel_rays(rays.size());
  tbb::parallel_for(std::size_t{0}, rays.size(), [&](std::size_t i) {
    voxel_rays[i] = in_voxels(rays[i].origin, rays[i].direction);
  });
  return voxel_rays;
}

void DensityTarget::closest(std::span<const render::Ray> rays,
                            std::span<render::Spot> spots) const {
  std::vector<VoxelHit> hits(rays.size());
  surface_->caster().closest(in_voxels(rays), hits);
  const auto voxels = static_cast<float>(voxels_);
  tbb::parallel_for(std::size_t{0}, rays.size(), [&](std::size_t i) {
    render::Spot& spot = spots[i];
    spot = {};
    if (std::isinf(hits[i].distance)) return;
    const auto& [origin, direction] = rays[i];
    const Vec3f outward = normalized(-hits[i].gradient);
    spot.distance = hits[i].distance / voxels;
    spot.object = render::Object::foliage;
    spot.normal = outward == Vec3f{}            ? -direction
                  : dot(outward, direction) > 0 ? -outward
                                                : outward;
    spot.face_normal = spot.normal;
    spot.start = origin + direction * spot.distance + spot.normal * (kLift / voxels);
    spot.color = color_;
  });
}

void DensityTarget::occluded(std::span<const render::Ray> rays, float reach,
                             std::span<std::uint8_t> answers) const {
  std::vector<float> blocked(rays.size());
  surface_->caster().blocked(in_voxels(rays), kHard * threshold(),
                             reach * static_cast<float>(voxels_), blocked);
  for (std::size_t i = 0; i < rays.size(); ++i) answers[i] = blocked[i] > 0;
}

void DensityTarget::openness(std::span<const render::Spot> spots,
                             std::span<const std::uint8_t> turns, std::span<float> open) const {
  const std::vector<Vec2f> directions = render::sobol_points(kTurns, 2);
  std::vector<VoxelRay> rays;
  std::vector<std::size_t> asked;
  for (std::size_t i = 0; i < spots.size(); ++i) {
    open[i] = 0;
    if (!spots[i].hit()) continue;
    const Vec3f towards = render::cosine_direction(spots[i].normal, directions[turns[i]]);
    if (!(dot(towards, spots[i].face_normal) > 0)) continue;
    rays.push_back(in_voxels(spots[i].start, towards));
    asked.push_back(i);
  }
  std::vector<float> blocked(rays.size());
  surface_->caster().blocked(rays, threshold(), render::kSkyReach * static_cast<float>(voxels_),
                             blocked);
  for (std::size_t i = 0; i < asked.size(); ++i) open[asked[i]] = 1 - blocked[i];
}

float DensityTarget::threshold() const { return static_cast<float>(surface_->report().threshold); }

}  // namespace leafhull
