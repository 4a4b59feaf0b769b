// SPDX-License-Identifier: Apache-2.0
#include "surface/volume.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "leafhull/error.h"

namespace leafhull {
namespace {

using Tree = openvdb::FloatTree;

openvdb::Coord to_vdb(Coord c, openvdb::Coord offset) {
  return openvdb::Coord(c.x, c.y, c.z) + offset;
}

/// A tree of the field's bricks as leaf nodes, their values mapped by `value_of`, and of its inside
/// blocks as inactive tiles of value `inside`.
template <class ValueOf>
Tree::Ptr build_tree(const Field& field, openvdb::Coord offset, float background, float inside,
                     ValueOf value_of) {
  static_assert(Tree::LeafNodeType::SIZE == kBrickSamples);
  openvdb::initialize();
  auto tree = std::make_shared<Tree>(background);
  std::vector<Tree::LeafNodeType*> leaves;
  leaves.reserve(field.origins.size());
  for (const Coord origin : field.origins) {
    leaves.push_back(tree->touchLeaf(to_vdb(origin, offset)));
  }
  tbb::parallel_for(std::size_t{0}, leaves.size(), [&](std::size_t b) {
    leaves[b]->setValuesOn();
    float* values = leaves[b]->buffer().data();
    const float* samples = field.samples.data() + b * kBrickSamples;
    std::transform(samples, samples + kBrickSamples, values, value_of);
  });
  constexpr int kBrickTile = 1;  // the level whose tiles are the size of a leaf node
  for (const Block& block : field.inside) {
    for (int x = 0; x < block.edge; x += kBrickEdge) {
      for (int y = 0; y < block.edge; y += kBrickEdge) {
        for (int z = 0; z < block.edge; z += kBrickEdge) {
          tree->addTile(kBrickTile, to_vdb(block.origin + Coord{x, y, z}, offset), inside, false);
        }
      }
    }
  }
  return tree;
}

}  // namespace

openvdb::FloatGrid::Ptr density_grid(const Field& field) {
  const auto index = [](std::int64_t anchor) {
    if (std::abs(anchor) > std::numeric_limits<std::int32_t>::max() / 2) {
      throw Error(ErrorCode::output,
                  "the tree lies too many voxels from the origin for a .vdb grid",
                  "Move it closer to the origin or take larger voxels.");
    }
    return static_cast<std::int32_t>(anchor);
  };
  const Vec3<std::int64_t> anchor = field.lattice.anchor;
  const openvdb::Coord offset(index(anchor.x), index(anchor.y), index(anchor.z));
  const auto above =
      std::nextafter(static_cast<float>(field.threshold), std::numeric_limits<float>::infinity());
  auto grid =
      openvdb::FloatGrid::create(build_tree(field, offset, 0.0f, above, [](float n) { return n; }));
  grid->setName("density");
  grid->setGridClass(openvdb::GRID_FOG_VOLUME);
  grid->setTransform(openvdb::math::Transform::createLinearTransform(field.lattice.voxel_size));
  grid->insertMeta("threshold", openvdb::DoubleMetadata(field.threshold));
  return grid;
}

openvdb::FloatGrid::Ptr depth_grid(const Field& field) {
  const double threshold = field.threshold;
  // A sample at T itself is inside.
  constexpr float kAtThreshold = -std::numeric_limits<float>::min();
  const auto depth = [=](float n) {
    const auto d = static_cast<float>(threshold - static_cast<double>(n));
    return d == 0.0f ? kAtThreshold : d;
  };
  const auto outside = static_cast<float>(threshold);
  return openvdb::FloatGrid::create(build_tree(field, openvdb::Coord(0), outside, -outside, depth));
}

}  // namespace leafhull
