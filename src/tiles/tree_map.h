// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "density/local_kernel.h"
#include "leafhull/scene.h"
#include "leafhull/vec.h"

namespace leafhull {

/// Maps a model to its placed tree, along with its density: N(p) = N_model(A^-1 (p - t)). A map
/// that is no similarity turns spheres into ellipsoids, which are kernels as well.
class TreeMap {
 public:
  explicit TreeMap(const PlacedTree& tree);

  Vec3d operator()(Vec3d p) const { return linear(p) + position_; }
  /// The axis-aligned box around a box's image.
  Box operator()(const Box& box) const;
  /// A kernel of the model, placed; it keeps its weight. `falloff`: k.
  LatticeKernel operator()(const Kernel& kernel, const Lattice& lattice, int falloff) const;
  /// The largest factor by which lengths grow.
  double stretch() const { return stretch_; }
  /// The factor by which volumes grow, >= 0.
  double volume() const { return volume_; }
  /// The factor by which areas grow, whatever way they face.
  double area() const { return scale_ * scale_; }

 private:
  Vec3d linear(Vec3d p) const { return {dot(x_, p), dot(y_, p), dot(z_, p)}; }

  Vec3d x_, y_, z_;                 // rows of A
  Vec3d over_x_, over_y_, over_z_;  // columns of A^-1
  Vec3d position_;
  double scale_, stretch_, volume_;
  bool similar_;
};

}  // namespace leafhull
