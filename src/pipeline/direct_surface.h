// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <optional>

#include "density/brick_grid.h"
#include "density/field.h"
#include "device/ray_caster.h"
#include "leafhull/shape.h"

namespace leafhull {

/// The surface N = T, ready for rays without polygons.
class DirectSurface {
 public:
  /// Of a tree: stages 1 to 6 of Figure 8; N along a ray comes from the kernels. Components below
  /// --min-component, and with it what the lattice does not see, are not drawn.
  /// @throws Error as extract does.
  DirectSurface(const LeafSet& leaves, const Options& options, Device& device,
                const Progress& progress = {});
  /// Of a sampled field, N between the samples trilinear. All of it is drawn.
  /// @throws Error empty: no sample reaches T; usage: spread too wide; device.
  DirectSurface(std::shared_ptr<const Field> field, Device& device);
  ~DirectSurface();
  DirectSurface(DirectSurface&&) noexcept;

  RayCaster& caster() const;
  const Lattice& lattice() const;
  /// What the extraction did, as far as it went; of a tree alone.
  const Report& report() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace leafhull
