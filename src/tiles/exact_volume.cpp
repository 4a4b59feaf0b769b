// SPDX-License-Identifier: Apache-2.0
#include "tiles/exact_volume.h"

#include <tbb/parallel_for.h>

#include <array>

#include "surface/mesh_components.h"

namespace leafhull {
namespace {

/// Counts modulo 2^128: sums and products on the way may exceed it, the volume does not.
__extension__ typedef unsigned __int128 Wide;  // NOLINT(modernize-use-using)

/// A point relative to the origin of the global lattice.
Vec3<Wide> exact(Vec3f p, const Lattice& lattice) {
  const auto at = [](std::int64_t anchor, float v) {
    const auto units = static_cast<std::int64_t>(static_cast<double>(v) * 0x1p14);
    return static_cast<Wide>(static_cast<ExactVolume>((anchor << 14) + units));
  };
  return {at(lattice.anchor.x, p.x), at(lattice.anchor.y, p.y), at(lattice.anchor.z, p.z)};
}

}  // namespace

/// A quad counts as the mean of its two foldings.
std::vector<std::pair<std::uint32_t, ExactVolume>> exact_volumes(
    const Polygons& polygons, const Lattice& lattice, const std::vector<std::uint32_t>& root) {
  std::vector<Wide> part(polygons.faces.size());
  tbb::parallel_for(std::size_t{0}, part.size(), [&](std::size_t f) {
    std::array<Vec3<Wide>, 4> c;
    for (std::size_t i = 0; i < 4; ++i)
      c[i] = exact(polygons.points[polygons.faces[f][i]], lattice);
    const auto& [p, q, r, s] = c;
    part[f] = dot(p, cross(q, r) + cross(r, s) + cross(q, s)) + dot(q, cross(r, s));
  });
  std::vector<std::uint32_t> place(polygons.points.size());
  std::vector<std::pair<std::uint32_t, ExactVolume>> volumes;
  for (std::uint32_t v = 0; v < place.size(); ++v) {
    if (root[v] != v) continue;
    place[v] = static_cast<std::uint32_t>(volumes.size());
    volumes.emplace_back(v, 0);
  }
  for (std::size_t f = 0; f < part.size(); ++f) {
    ExactVolume& sum = volumes[place[root[polygons.faces[f][0]]]].second;
    sum = static_cast<ExactVolume>(static_cast<Wide>(sum) + part[f]);
  }
  return volumes;
}

std::vector<std::pair<std::uint32_t, ExactVolume>> exact_volumes(const Polygons& polygons,
                                                                 const Lattice& lattice) {
  return exact_volumes(polygons, lattice, component_of_each(polygons));
}

}  // namespace leafhull
