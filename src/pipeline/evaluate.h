// SPDX-License-Identifier: Apache-2.0
// Carries lists from the density room to the device and results back.
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "density/band.h"
#include "density/field.h"
#include "density/kernel_set.h"
#include "device/evaluator.h"
#include "leafhull/shape.h"

namespace leafhull {

/// A kernel set on a lattice, ready to be evaluated.
class DensityFunction {
 public:
  /// `hash` is over the centres of `kernels`.
  DensityFunction(Device& device, std::span<const Kernel> kernels,
                  std::shared_ptr<const SpatialHash> hash, const Lattice& lattice, int falloff)
      : DensityFunction(device, KernelSet(kernels, std::move(hash), lattice, falloff), falloff) {}
  DensityFunction(Device& device, KernelSet kernels, int falloff)
      : kernels_(std::move(kernels)), evaluator_(device, kernels_, falloff), falloff_(falloff) {}
  DensityFunction(const DensityFunction&) = delete;
  DensityFunction& operator=(const DensityFunction&) = delete;

  /// N at points given in voxels from the lattice's anchor.
  std::vector<float> at(std::span<const Vec3d> points);

  /// N interpolated trilinearly from the lattice at points given in voxels from its anchor: step 2
  /// of the paper's Figure 8.
  std::vector<float> interpolated_at(std::span<const Vec3d> points);

  struct Sampled {
    Field field;
    std::uint64_t pairs = 0;  ///< kernel-sample pairs evaluated
  };
  /// Whether to keep the lists of kernels near each brick: never, only while they take 64 MiB or
  /// less, or always.
  enum class Lists { forget, keep_few, keep };
  /// N where a surface N = T may be, for all `thresholds`, ascending; if `dense`, wherever a
  /// support reaches. Blocks are grown by `margin` voxels before they are decided. `advance` gets
  /// the share that is done. The field's own threshold is the lowest.
  Sampled sample_band(std::vector<double> thresholds, int margin, bool dense, Lists lists,
                      const std::function<void(double)>& advance);
  /// As above for one threshold, in the bricks that meet `range`.
  Sampled sample_band(double threshold, const SampleBox& range);

  /// The kernels near each brick of the last field sampled, in the field's order, if kept; valid
  /// until the next is sampled.
  const BrickList* lists() const { return lists_ ? &*lists_ : nullptr; }

  /// Moves points onto N = threshold within their cells, in at most `steps` steps, and returns the
  /// outward unit normals there, zero where the gradient vanishes. Kept lists make it quicker.
  std::vector<Vec3f> snap(std::span<Vec3f> points, double threshold, int steps);
  /// As above, but points are multiples of 2^-20 voxels, so that they do not depend on the anchor.
  std::vector<Vec3f> snap(std::span<Vec3d> points, double threshold, int steps);

  const KernelSet& kernels() const { return kernels_; }

 private:
  template <class T>
  std::vector<Vec3f> snap_points(std::span<Vec3<T>> points, double threshold, int steps);
  Sampled sample(const BandOptions& options, Field empty, Lists lists,
                 const std::function<void(double)>& advance);

  KernelSet kernels_;
  Evaluator evaluator_;
  std::optional<BrickList> lists_;
  int falloff_;
};

}  // namespace leafhull
