// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "density/descent.h"
#include "density/points.h"
#include "leafhull/device.h"

namespace leafhull {

/// Evaluates N on a device for one kernel set on one lattice. Every call returns when its results
/// are there. A sum runs over its list in order, so results depend on the list alone.
class Evaluator {
 public:
  /// Sends the kernels, which must outlive the evaluator, to the device. @throws Error device, as
  /// all calls do: out of memory, a failing driver.
  Evaluator(Device& device, const KernelSet& kernels, int falloff);
  ~Evaluator();
  Evaluator(Evaluator&&) noexcept;

  /// N at the samples of `bricks`: writes kBrickSamples floats per brick, z fastest. Returns the
  /// kernel-sample pairs that were evaluated.
  std::uint64_t sample(const BrickList& bricks, std::span<float> samples);

  /// Points per chunk of the batches below.
  std::size_t chunk_points() const;

  /// N at the points of a batch, in the order of batch.index.
  std::vector<float> density(PointBatch& batch);

  /// Moves the points of a batch onto N = threshold and returns the normals there, zero where the
  /// gradient vanishes. With 0 steps it only returns the normals.
  struct Normals {
    std::vector<float> x, y, z;
  };
  Normals snap(PointBatch& batch, double threshold, int steps);

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

/// Runs every kernel once on nothing, so that it is built: PoCL compiles at the first launch.
/// @throws Error device.
void prepare(Device& device, int falloff);

}  // namespace leafhull
