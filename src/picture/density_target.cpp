// SPDX-License-Identifier: Apache-2.0
#include "picture/density_target.h"

#include <tbb/parallel_for.h>

#include <vector>

namespace leafhull {
namespace {

/// Light is looked for from this far above the surface, voxels: there the samples, between which N
/// is a trilinear guess, are past the surface too.
constexpr float kLift = 1.5f;

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

void DensityTarget::closest(std::span<const render::Ray> rays,
                            std::span<render::Spot> spots) const {
  std::vector<VoxelRay> voxel_rays(rays.size());
  std::vector<VoxelHit> hits(rays.size());
  tbb::parallel_for(std::size_t{0}, rays.size(), [&](std::size_t i) {
    voxel_rays[i] = in_voxels(rays[i].origin, rays[i].direction);
  });
  surface_->caster().closest(voxel_rays, hits);
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
    spot.position = origin + direction * spot.distance + spot.normal * (kLift / voxels);
    spot.color = color_;
  });
}

void DensityTarget::occluded(std::span<const render::Ray> rays, float reach,
                             std::span<std::uint8_t> answers) const {
  std::vector<VoxelRay> voxel_rays(rays.size());
  tbb::parallel_for(std::size_t{0}, rays.size(), [&](std::size_t i) {
    voxel_rays[i] = in_voxels(rays[i].origin, rays[i].direction);
  });
  surface_->caster().occluded(voxel_rays, reach * static_cast<float>(voxels_), answers);
}

void DensityTarget::openness(std::span<const render::Spot> spots,
                             std::span<const std::uint8_t> /*turns*/, std::span<float> open) const {
  std::vector<VoxelRay> points(spots.size());
  tbb::parallel_for(std::size_t{0}, spots.size(), [&](std::size_t i) {
    const render::Spot& spot = spots[i];
    points[i] = in_voxels(spot.position, spot.hit() ? spot.normal : Vec3f(0, 1, 0));
  });
  const double reach = surface_->surroundings() / surface_->lattice().voxel_size;
  surface_->caster().openness(points, static_cast<float>(reach), open);
}

}  // namespace leafhull
