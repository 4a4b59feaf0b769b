// SPDX-License-Identifier: Apache-2.0
#include "surface/density_grid.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <functional>
#include <limits>
#include <memory>

#include "density/field_grid.h"
#include "leafhull/error.h"

namespace leafhull {
namespace {

/// The anchor in the grid's 32-bit coordinates.
openvdb::Coord anchor_of(const Lattice& lattice) {
  const auto index = [](std::int64_t anchor) {
    if (std::abs(anchor) > std::numeric_limits<std::int32_t>::max() / 2) {
      throw Error(ErrorCode::output,
                  "the tree lies too many voxels from the origin for a .vdb grid",
                  "Move it closer to the origin or use larger voxels.");
    }
    return static_cast<std::int32_t>(anchor);
  };
  return {index(lattice.anchor.x), index(lattice.anchor.y), index(lattice.anchor.z)};
}

}  // namespace

openvdb::FloatGrid::Ptr density_grid(const Field& field) {
  openvdb::initialize();
  const openvdb::Coord anchor = anchor_of(field.lattice());
  auto grid = openvdb::FloatGrid::create(0.0f);
  grid->setName("density");
  grid->setGridClass(openvdb::GRID_FOG_VOLUME);
  grid->setTransform(openvdb::math::Transform::createLinearTransform(field.lattice().voxel_size));
  grid->insertMeta("threshold", openvdb::DoubleMetadata(field.threshold()));

  std::vector<std::unique_ptr<Brick>> bricks(bricks_of(field).size());
  tbb::parallel_for(std::size_t{0}, bricks.size(), [&](std::size_t b) {
    bricks[b] = std::make_unique<Brick>(*bricks_of(field)[b]);
    bricks[b]->setOrigin(bricks[b]->origin() + anchor);
    float* const values = bricks[b]->buffer().data();
    std::transform(values, values + Brick::SIZE, values, std::negate<>());
  });
  for (auto& brick : bricks) grid->tree().addLeaf(brick.release());
  for (const Block& block : field.inside()) {
    openvdb::CoordBBox samples = samples_of(block);
    samples.translate(anchor);
    grid->tree().fill(samples, inside_value(field.threshold()), /*active=*/false);
  }
  return grid;
}

}  // namespace leafhull
