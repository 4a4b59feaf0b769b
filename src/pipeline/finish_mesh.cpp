// SPDX-License-Identifier: Apache-2.0
#include "pipeline/finish_mesh.h"

#include <tbb/parallel_for.h>
#include <tbb/parallel_reduce.h>

#include <algorithm>
#include <cmath>

namespace leafhull {
namespace {

constexpr int kSnapSteps = 12;

double largest_coordinate(std::span<const Vec3f> positions, const Lattice& lattice) {
  return tbb::parallel_reduce(
      tbb::blocked_range<std::size_t>(0, positions.size()), 0.0,
      [&](const tbb::blocked_range<std::size_t>& range, double largest) {
        for (const Vec3f p : positions.subspan(range.begin(), range.size())) {
          const Vec3d w = lattice.world(Vec3d(p));
          largest = std::max({largest, std::fabs(w.x), std::fabs(w.y), std::fabs(w.z)});
        }
        return largest;
      },
      [](double a, double b) { return std::max(a, b); });
}

/// Lattice positions in model units. The origin moves to the lattice's anchor only where a float at
/// the scene's coordinates would be coarser than a thousandth of a voxel.
void to_model_units(Mesh& mesh, const Lattice& lattice) {
  constexpr double kFloatStep = 6e-8;
  if (largest_coordinate(mesh.positions, lattice) * kFloatStep > 1e-3 * lattice.voxel_size) {
    mesh.origin = lattice.world({0, 0, 0});
  }
  tbb::parallel_for(std::size_t{0}, mesh.positions.size(), [&](std::size_t v) {
    Vec3f& p = mesh.positions[v];
    p = Vec3f(lattice.world(Vec3d(p)) - mesh.origin);
  });
}

/// Where the gradient vanishes, takes the mean normal of the faces around the vertex.
void fill_missing_normals(Mesh& mesh) {
  const auto is_missing = [](Vec3f normal) { return normal == Vec3f{}; };
  if (std::none_of(mesh.normals.begin(), mesh.normals.end(), is_missing)) return;
  std::vector<Vec3d> sum(mesh.positions.size());
  const auto missing = [&](std::uint32_t v) { return is_missing(mesh.normals[v]); };
  for (const auto& [a, b, c] : mesh.triangles) {
    if (!missing(a) && !missing(b) && !missing(c)) continue;
    const Vec3d p(mesh.positions[a]);
    const Vec3d area = cross(Vec3d(mesh.positions[b]) - p, Vec3d(mesh.positions[c]) - p);
    for (const std::uint32_t v : {a, b, c}) sum[v] = sum[v] + area;
  }
  for (std::uint32_t v = 0; v < sum.size(); ++v) {
    if (!missing(v)) continue;
    const Vec3d mean = normalized(sum[v]);
    mesh.normals[v] =
        mean == Vec3d{} ? Vec3f(0, 1, 0) : Vec3f(mean);  // faces without area: any will do
  }
}

void take(Polygons polygons, Mesh& mesh) {
  mesh.triangles = triangulate(polygons);
  mesh.positions = std::move(polygons.points);
}

}  // namespace

Mesh finish_mesh(Polygons polygons, DensityFunction& density, const Lattice& lattice,
                 double threshold, bool snap) {
  Mesh mesh;
  mesh.normals = density.snap(polygons.points, threshold, snap ? kSnapSteps : 0);
  take(std::move(polygons), mesh);
  fill_missing_normals(mesh);
  to_model_units(mesh, lattice);
  return mesh;
}

Mesh lattice_mesh(Polygons polygons, const Lattice& lattice) {
  Mesh mesh;
  take(std::move(polygons), mesh);
  mesh.normals.resize(mesh.positions.size());
  fill_missing_normals(mesh);
  to_model_units(mesh, lattice);
  return mesh;
}

}  // namespace leafhull
