// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>

#include "density/brick_grid.h"
#include "density/field.h"
#include "device/ray_caster.h"
#include "leafhull/shape.h"

namespace leafhull {

/// The surface N = T, ready for rays without polygons.
class DirectSurface {
 public:
  /// The surface of a tree, by stages 1 to 6 of Figure 8; N along a ray comes from the kernels.
  /// Components below --min-component are not drawn, nor parts that the lattice does not resolve.
  /// @throws Error as extract does.
  DirectSurface(const LeafSet& leaves, const Options& options, Device& device,
                const Progress& progress = {});
  /// The surface of a sampled field, trilinear between the samples. All of it is drawn.
  /// @throws Error empty: no sample reaches T; usage: spread too wide; device.
  DirectSurface(std::shared_ptr<const Field> field, Device& device);
  ~DirectSurface();
  DirectSurface(DirectSurface&&) noexcept;

  RayCaster& caster() const;
  const Lattice& lattice() const;
  /// The report of the extraction up to this stage; only for a tree.
  const Report& report() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace leafhull
