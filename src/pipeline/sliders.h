// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "pipeline/pieces.h"
#include "pipeline/sample.h"
#include "pipeline/stages.h"

namespace leafhull {

/// A sampled field with its hollows filled, and its surface.
struct SampledSurface {
  Sampled sampled;
  Pieces pieces;
};

/// Prepares a tree, and finds R_max for the dilation and T for the erosion that its options ask
/// for, if any.
class Sliders {
 public:
  /// `run` and `stages` must outlive it.
  Sliders(const Run& run, Stages& stages, Options resolved);

  /// Prepares the tree with R_max and T as far as the leaves alone determine them.
  /// @throws Error usage: an erosion or a dilation that this tree cannot have.
  Prepared prepare();

  /// The surface. If its erosion on the lattice is too far from the requested one, replaces
  /// `prepared` by one with another T and, if there is a dilation, another R_max.
  /// @throws Error usage: as sample(); no T has that erosion.
  SampledSurface surface(Prepared& prepared,
                         DensityFunction::Lists lists = DensityFunction::Lists::forget);

  /// Called by prepare() or, with an erosion, by surface(), which may still correct the dilation.
  /// @throws Error usage: the requested dilation was not found.
  void check_dilation(const Prepared& prepared);

 private:
  Prepared solve();
  bool is_eroded(const Prepared& prepared, const SampledSurface& surface, bool is_last);

  const Run& run_;
  Stages& stages_;
  Options options_;
  bool finds_radius_;
  double below_;               ///< the share of the leaves that T leaves out
  double low_ = 0, high_ = 1;  ///< shares between which it lies
};

}  // namespace leafhull
