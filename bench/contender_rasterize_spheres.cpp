// SPDX-License-Identifier: Apache-2.0
// OpenVDB's rasterizeSmoothSpheres (Zhu and Bridson 2005), the nearest peer: it sums a kernel of
// radius R around every point, as leafhull does. The surface lies where the mean of the points in
// reach is R / 2 away; at R it would lie where the sums end.
#include <openvdb/points/PointConversion.h>
#include <openvdb/points/PointRasterizeSDF.h>

#include "bench/openvdb_mesh.h"

namespace leafhull::bench {
namespace {

openvdb::FloatGrid::Ptr make_field(const std::vector<openvdb::Vec3d>& positions, double radius,
                                   double voxel) {
  namespace points = openvdb::points;
  const points::PointAttributeVector<openvdb::Vec3d> wrapper(positions);
  const auto transform = openvdb::math::Transform::createLinearTransform(voxel);
  const auto index =
      openvdb::tools::createPointIndexGrid<openvdb::tools::PointIndexGrid>(wrapper, *transform);
  const auto grid = points::createPointDataGrid<points::NullCodec, points::PointDataGrid>(
      *index, wrapper, *transform);
  return points::rasterizeSmoothSpheres(*grid, radius / 2, radius);
}

}  // namespace
}  // namespace leafhull::bench

int main(int argc, char** argv) {
  CLI::App app("OpenVDB's rasterizeSmoothSpheres and volumeToMesh.");
  return leafhull::bench::serve(app, argc, argv, [](const auto& c, int threads) {
    return leafhull::bench::openvdb_contender(
        "OpenVDB rasterizeSmoothSpheres", c, threads,
        [radius = c.radius, voxel = c.voxel](const auto& points) {
          return leafhull::bench::make_field(points, radius, voxel);
        });
  });
}
