// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "density/local_kernel.h"
#include "density/points.h"
#include "leafhull/device.h"

namespace leafhull {

/// Evaluates N on a device for one kernel set on one lattice. Every call returns when its results
/// are there. A sum runs over its list in order, so results depend on the list alone.
class Evaluator {
 public:
  /// Uploads the kernels. @throws Error device, as all calls do: out of memory, a failing driver.
  Evaluator(Device& device, std::span<const Kernel> kernels, const Lattice& lattice, int falloff);
  ~Evaluator();
  Evaluator(Evaluator&&) noexcept;

  /// N at the samples of `bricks`: writes kBrickSamples floats per brick, z fastest. Returns the
  /// kernel-sample pairs that were evaluated.
  std::uint64_t sample(const BrickList& bricks, std::span<float> samples);

  /// N at the points of a batch, in the order of batch.index.
  std::vector<float> density(const PointBatch& batch);

  /// A batch's points, moved onto N = threshold, as offsets from their brick's origin, and the
  /// normals there (zero where the gradient vanishes). No steps: only the normals.
  struct Snapped {
    std::vector<Vec3f> offset, normal;
  };
  Snapped snap(const PointBatch& batch, double threshold, int steps);

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

/// Runs every kernel once on nothing, so that it is built: PoCL compiles at the first launch.
/// @throws Error device.
void prepare(Device& device, int falloff);

}  // namespace leafhull
