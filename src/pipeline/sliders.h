// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "pipeline/pieces.h"
#include "pipeline/sample.h"
#include "pipeline/stages.h"

namespace leafhull {

/// A sampled field, hollows filled, and its surface.
struct SampledSurface {
  Sampled sampled;
  Pieces pieces;
};

/// Prepares a tree, and finds R_max for the dilation and T for the erosion that its options ask
/// for; where they ask for neither there is nothing to find.
class Sliders {
 public:
  /// Both must outlive it.
  Sliders(const Run& run, Stages& stages, Options resolved);

  /// R_max and T as far as the leaves alone tell them.
  /// @throws Error usage: an erosion or a dilation that this tree cannot have.
  Prepared prepare();

  /// The surface. Where the lattice shows an erosion that is too far from what is asked for,
  /// `prepared` is replaced by one with another T and, with a dilation, another R_max.
  /// @throws Error usage: as sample(); no T has that erosion.
  SampledSurface surface(Prepared& prepared, Mesher mesher,
                         DensityFunction::Lists lists = DensityFunction::Lists::forget);

  /// prepare() sees to it, but with an erosion, which surface() may still correct.
  /// @throws Error usage: the dilation that is asked for was not found.
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
