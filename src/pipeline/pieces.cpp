// SPDX-License-Identifier: Apache-2.0
#include "pipeline/pieces.h"

#include <utility>

#include "surface/brick_mesher.h"
#include "surface/mesh_components.h"

namespace leafhull {

Pieces polygonise(const Run& run, const Field& field, const Options& resolved) {
  run.watch.start("polygonise");
  const double adaptivity = resolved.adaptivity;
  Pieces pieces;
  pieces.polygons =
      resolved.mesher == Mesher::bricks ? mesh_bricks(field) : polygonise(field, adaptivity);
  ComponentCount components = drop_small_components(pieces.polygons, *resolved.min_component);
  pieces.kept = components.kept;
  pieces.dropped = components.dropped;
  if (adaptivity > 0 && components.dropped > 0) {  // merged vertices leave cells out
    Polygons fine = mesh_bricks(field);
    components = drop_small_components(fine, *resolved.min_component);
  }
  pieces.dropped_cells = std::move(components.dropped_cells);
  return pieces;
}

}  // namespace leafhull
