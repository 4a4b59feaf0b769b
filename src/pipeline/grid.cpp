// SPDX-License-Identifier: Apache-2.0
#include "pipeline/grid.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include "leafhull/error.h"
#include "text/numbers.h"

namespace leafhull {
namespace {

/// The most voxels along the crown that a lattice coordinate can count. The memory check refuses
/// far fewer, but it runs after the isotropic density from the grid.
constexpr double kMostVoxels = 1e9;
constexpr double kMostVoxelsOfGridDensity = 1e6 * (1 + 1e-9);
/// A radius of more crowns than this is a mistake, and its support would make a huge lattice.
constexpr double kLargestRadius = 100;

std::string number(double value) { return significant(value, 4); }

void check_radii(const LeafSet& leaves, double radius_max) {
  if (leaves.vertices.empty()) {
    throw Error(ErrorCode::input, "there are no leaf vertices", "Give leaves that have an area.");
  }
  if (leaves.crown.empty()) throw Error(ErrorCode::internal, "LeafSet::crown is not set");
  if (!std::isfinite(radius_max)) {
    throw Error(ErrorCode::usage, "R_max is not finite", "Lower --radius-max.");
  }
  const double crown = leaves.crown.longest_side();
  if (crown > 0 && radius_max > kLargestRadius * crown) {
    throw Error(ErrorCode::usage,
                "R_max, " + number(radius_max) + " model units, is more than " +
                    number(kLargestRadius) + " times the crown of " + number(crown),
                "Lower --radius-max or check --radius-unit.");
  }
  float largest = 0;
  for (const LeafVertex& leaf : leaves.vertices) largest = std::max(largest, leaf.radius_major);
  if (largest > kLargestRadius * (crown + 2 * radius_max)) {
    throw Error(ErrorCode::usage,
                "a leaf's radius, " + number(static_cast<double>(largest)) +
                    " model units, is more than " + number(kLargestRadius) +
                    " times the crown of " + number(crown),
                "Lower --leaf-scale or check --ellipse.");
  }
}

void check_voxels(const LeafSet& leaves, double side, double voxel_size, DensitySource density) {
  if (!(side > 0)) {
    throw Error(ErrorCode::input, "the crown has no extent: all leaf vertices are at one point",
                "Repair the model, or give --radius-max with --radius-unit model.");
  }
  const double most = density == DensitySource::grid ? kMostVoxelsOfGridDensity : kMostVoxels;
  if (side / voxel_size > most || voxel_size > side) {
    throw Error(ErrorCode::usage,
                "a voxel of " + number(voxel_size) + " does not suit a crown of " + number(side) +
                    " model units with R_max on both sides",
                "Give a --voxel-size from " + number(side / most) + " to " + number(side) +
                    ", or a --resolution.");
  }
  if (leaves.bounds.longest_side() / voxel_size > kMostVoxels) {
    throw Error(ErrorCode::input,
                "leaves lie " + number(leaves.bounds.longest_side()) +
                    " model units apart, too far for voxels of " + number(voxel_size),
                "Remove those far from the crown, or choose others with --leaves.");
  }
  const Box& b = leaves.bounds;
  double farthest = 0;
  for (const double c : {b.low.x, b.low.y, b.low.z, b.high.x, b.high.y, b.high.z}) {
    farthest = std::max(farthest, std::fabs(c));
  }
  if (farthest * std::numeric_limits<double>::epsilon() > 0.01 * voxel_size) {
    throw Error(ErrorCode::input,
                "the crown lies " + number(farthest) +
                    " model units from the origin, too far for " + "voxels of " +
                    number(voxel_size),
                "Move the tree closer to the origin.");
  }
}

}  // namespace

Grid grid_of(const LeafSet& leaves, const Options& resolved) {
  Grid grid;
  grid.radius_max = radius_max_in_model_units(leaves, resolved);
  check_radii(leaves, grid.radius_max);
  const double side = leaves.crown.longest_side() + 2 * grid.radius_max;
  grid.voxel_size = resolved.voxel_size ? *resolved.voxel_size : side / *resolved.resolution;
  check_voxels(leaves, side, grid.voxel_size, resolved.density);
  grid.resolution = static_cast<int>(std::lround(side / grid.voxel_size));
  grid.lattice = Lattice::near(leaves.crown.low, grid.voxel_size);
  return grid;
}

Lattice hash_cells(const LeafSet& leaves, double radius_max) {
  constexpr double kSmallestPart = 1.0 / 256;
  constexpr double kSmallestPartOfAll = 1.0 / (1 << 26);  // a coordinate can count these
  const double cell = std::max({radius_max, leaves.crown.longest_side() * kSmallestPart,
                                leaves.bounds.longest_side() * kSmallestPartOfAll});
  return Lattice::near(leaves.crown.low, cell);
}

Lattice leaf_lattice(const LeafSet& leaves, double radius_max) {
  const double cell = hash_cells(leaves, radius_max).voxel_size;
  return Lattice::near(leaves.crown.low, cell / kBrickEdge);
}

}  // namespace leafhull
