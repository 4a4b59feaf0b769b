// SPDX-License-Identifier: Apache-2.0
#include "bench/pairs.h"

#include <openvdb/tools/PointIndexGrid.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>

#include "density/points.h"
#include "pipeline/grid.h"
#include "surface/density_grid.h"

namespace leafhull::bench {
namespace {

using openvdb::Vec3d;

Vec3d vdb(const leafhull::Vec3d& v) { return {v.x, v.y, v.z}; }
Vec3d vdb(const Vec3f& v) { return {v.x, v.y, v.z}; }

/// The unit axes over their radii, so that xi is a squared length. Source: Eq. (3).
struct Support {
  Vec3d centre;
  std::array<Vec3d, 3> axes;
  Vec3d extent;  // half its axis-aligned box

  explicit Support(const Kernel& k) : centre(vdb(k.centre)), extent(0.0) {
    const Vec3d normal = vdb(k.normal), major = vdb(k.major);
    const std::array<Vec3d, 3> axis = {major, normal.cross(major), normal};
    const std::array<double, 3> radius = {k.radius_major, k.radius_minor, k.radius_normal};
    for (std::size_t a = 0; a < 3; ++a) {
      axes[a] = axis[a] / radius[a];
      extent += axis[a] * axis[a] * (radius[a] * radius[a]);
    }
    for (int i = 0; i < 3; ++i) extent[i] = std::sqrt(extent[i]);
  }

  bool holds(const Vec3d& p) const {
    double xi = 0;
    for (const Vec3d& axis : axes) xi += std::pow(axis.dot(p - centre), 2);
    return xi < 1;
  }
};

/// Kernel centres as OpenVDB's PointArray.
struct Centres {
  using PosType = Vec3d;

  const std::vector<Support>& supports;

  std::size_t size() const { return supports.size(); }
  void getPos(std::size_t n, Vec3d& position) const { position = supports[n].centre; }
};

/// Counts the supports that hold `point`, as a filter of PointIndexFilter.
struct Counter {
  const std::vector<Support>& supports;
  Vec3d point{0.0};
  std::uint64_t inside = 0;

  void reset() {}
  void operator()(double, std::size_t n) { inside += supports[n].holds(point) ? 1 : 0; }
};

std::vector<Support> supports_of(std::span<const Kernel> kernels) {
  return {kernels.begin(), kernels.end()};
}

/// The box of a chunk.
PlaceBox box_of(const ChunkBoxes& boxes, std::size_t chunk) {
  const auto row = [&](std::size_t i) { return boxes[i][chunk]; };
  return {{row(0), row(1), row(2)}, {row(3), row(4), row(5)}};
}

}  // namespace

std::uint64_t pairs_inside(std::span<const Kernel> kernels, const Field& field) {
  const openvdb::FloatGrid::ConstPtr samples = density_grid(field);
  const openvdb::math::Transform& lattice = samples->transform();
  auto evaluated = samples->getConstAccessor();
  std::uint64_t inside = 0;
  for (const Support& support : supports_of(kernels)) {
    const auto box = openvdb::CoordBBox(
        openvdb::Coord::ceil(lattice.worldToIndex(support.centre - support.extent)),
        openvdb::Coord::floor(lattice.worldToIndex(support.centre + support.extent)));
    for (auto sample = box.begin(); sample; ++sample) {
      if (evaluated.isValueOn(*sample) && support.holds(lattice.indexToWorld(*sample))) ++inside;
    }
  }
  return inside;
}

std::uint64_t pairs_inside(std::span<const Kernel> kernels, std::span<const LeafVertex> leaves) {
  const std::vector<Support> supports = supports_of(kernels);
  double reach = 0;
  for (const Kernel& k : kernels) {
    reach = std::max<double>({reach, k.radius_major, k.radius_minor, k.radius_normal});
  }
  const Centres centres{supports};
  const auto cells = openvdb::math::Transform::createLinearTransform(reach);
  const auto index =
      openvdb::tools::createPointIndexGrid<openvdb::tools::PointIndexGrid>(centres, *cells);
  openvdb::tools::PointIndexFilter<Centres> filter(centres, index->tree(), *cells);
  Counter counter{supports};
  for (const LeafVertex& leaf : leaves) {
    counter.point = vdb(leaf.position);
    filter.searchAndApply(counter.point, reach, counter);
  }
  return counter.inside;
}

std::uint64_t pairs_evaluated(std::span<const Kernel> kernels, const LeafSet& leaves,
                              double radius_max, int falloff) {
  const auto hash = std::make_shared<const SpatialHash>(kernels, hash_cells(leaves, radius_max));
  const KernelSet set(kernels, hash, leaf_lattice(leaves, radius_max), falloff);
  std::vector<leafhull::Vec3d> points;
  for (const LeafVertex& leaf : leaves.vertices) {
    points.push_back(set.lattice().local(leaf.position));
  }
  std::uint64_t pairs = 0;
  constexpr std::size_t kChunkPoints = 8;
  const auto count = [&](const PointBatch& batch) {
    for (std::size_t g = 0; g < batch.groups.size(); ++g) {
      const PointGroup& group = batch.groups[g];
      for (std::uint32_t i = group.first; i < group.end; ++i) {
        const LatticeKernel& kernel = set.kernels()[batch.bricks.kernels[i]];
        for (std::size_t c = 0; c < group.count; ++c) {
          if (reaches(kernel, group.origin, box_of(batch.boxes[g], c))) pairs += kChunkPoints;
        }
      }
    }
  };
  find_kernels_near(set, std::span<const leafhull::Vec3d>(points), {Within::point, kChunkPoints},
                    count);
  return pairs;
}

}  // namespace leafhull::bench
