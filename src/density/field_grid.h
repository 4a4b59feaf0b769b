// SPDX-License-Identifier: Apache-2.0
// The part of a field that exposes OpenVDB, whose headers take seconds to compile.
#pragma once

#include <openvdb/openvdb.h>

#include <span>
#include <vector>

#include "density/field.h"

namespace leafhull {

/// An evaluated brick of -N, z fastest.
using Brick = openvdb::FloatTree::LeafNodeType;

struct Field::Grid {
  openvdb::FloatGrid::Ptr negated = openvdb::FloatGrid::create(0.0f);
  std::vector<Brick*> bricks;
};

/// -N in voxels from the anchor. OpenVDB's mesher needs this sign: values below the iso-value are
/// inside. Evaluated samples are active; blocks proven inside are tiles.
inline const openvdb::FloatGrid& negated_grid(const Field& field) { return *field.grid().negated; }

/// The evaluated bricks, leaf nodes of negated_grid(), in the order of their evaluation.
inline std::span<const Brick* const> bricks_of(const Field& field) { return field.grid().bricks; }

/// The samples of a block.
inline openvdb::CoordBBox samples_of(const Block& block) {
  const Coord o = block.origin;
  return openvdb::CoordBBox::createCube(openvdb::Coord(o.x, o.y, o.z), block.edge);
}

}  // namespace leafhull
