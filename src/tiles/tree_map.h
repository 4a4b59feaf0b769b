// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "density/local_kernel.h"
#include "leafhull/scene.h"
#include "leafhull/vec.h"

namespace leafhull {

/// Where a placed tree's model goes: a density is carried along, N(p) = N_model(A^-1 (p - t)).
/// Under a map that is no similarity spheres become ellipsoids, which are kernels as well.
class TreeMap {
 public:
  explicit TreeMap(const PlacedTree& tree);

  Vec3d operator()(Vec3d p) const { return linear(p) + position_; }
  /// The axis-aligned box around a box's image.
  Box operator()(const Box& box) const;
  /// A kernel of the model, placed; it keeps its weight. `falloff`: k.
  LatticeKernel operator()(const Kernel& kernel, const Lattice& lattice, int falloff) const;
  /// By how much lengths grow at most.
  double stretch() const { return stretch_; }
  /// By how much volumes grow, >= 0.
  double volume() const { return volume_; }
  /// By how much areas grow, whatever way they face.
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
