// SPDX-License-Identifier: Apache-2.0
// OpenVDB's ParticlesToLevelSet: the union of spheres of radius R around the leaf vertices.
#include <openvdb/tools/LevelSetUtil.h>
#include <openvdb/tools/ParticlesToLevelSet.h>

#include "bench/openvdb_mesh.h"

namespace leafhull::bench {
namespace {

struct Particles {
  using PosType = openvdb::Vec3R;

  const std::vector<openvdb::Vec3d>& positions;

  std::size_t size() const { return positions.size(); }
  void getPos(std::size_t n, openvdb::Vec3R& position) const { position = positions[n]; }
};

openvdb::FloatGrid::Ptr make_field(const std::vector<openvdb::Vec3d>& positions, double radius,
                                   double voxel) {
  const auto grid = openvdb::createLevelSet<openvdb::FloatGrid>(voxel);
  openvdb::tools::ParticlesToLevelSet<openvdb::FloatGrid> rasteriser(*grid);
  rasteriser.setRmin(0);  // no sphere is passed over for being small
  rasteriser.rasterizeSpheres(Particles{positions}, radius);
  rasteriser.finalize(true);
  return grid;
}

}  // namespace
}  // namespace leafhull::bench

int main(int argc, char** argv) {
  CLI::App app("OpenVDB's ParticlesToLevelSet and volumeToMesh.");
  return leafhull::bench::serve(app, argc, argv, [](const auto& c, int threads) {
    return leafhull::bench::openvdb_contender(
        "OpenVDB ParticlesToLevelSet", c, threads,
        [radius = c.radius, voxel = c.voxel](const auto& points) {
          return leafhull::bench::make_field(points, radius, voxel);
        });
  });
}
