// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <vector>

#include "leafhull/leaves.h"
#include "leaves/ellipse.h"
#include "leaves/leaf_components.h"
#include "leaves/sheets.h"

namespace leafhull {

/// Leaves in the order in which they were taken.
struct FoundLeaves {
  std::vector<LeafVertex> vertices{};  ///< those of one leaf are consecutive
  Box bounds{};                        ///< of the vertices
  SheetCollector sheets{};
  std::size_t count = 0;
  std::size_t dropped = 0;     ///< as LeafSet::dropped_leaves
  std::size_t split = 0;       ///< as LeafSet::split_components
  std::size_t untextured = 0;  ///< leaves whose texture should give their ellipse but does not

  void append(FoundLeaves&& next);
};

/// The components of a primitive, and where it stands.
struct LeafSource {
  const Primitive& primitive;
  const WeldedMesh& mesh;  ///< `primitive` welded
  const FaceGroups& components;
  std::vector<Transform> to_world{};  ///< one per instance
  TextureSource texture{};
  double scale = 1;  ///< multiplies R_u and R_v
};

/// Appends the leaves of every instance, component by component. Runs on all threads; neither the
/// leaves nor their order depend on the number of threads.
void collect_leaves(const LeafSource& source, FoundLeaves& found);

}  // namespace leafhull
