// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <vector>

#include "pipeline/prepared.h"
#include "pipeline/run.h"

namespace leafhull {

/// The last result of a stage, and what it was computed from.
template <class Key, class Value>
class Kept {
 public:
  /// The value by `work`, or the last one if it was for the same key.
  template <class Work>
  std::shared_ptr<Value> get(const Key& key, Work&& work) {
    if (key_ != key) {
      forget();  // gives its memory back before the next is made
      value_ = std::make_shared<Value>(work());
      key_ = key;
    }
    return value_;
  }

  void forget() {
    key_.reset();
    value_.reset();
  }

 private:
  std::optional<Key> key_;
  std::shared_ptr<Value> value_;
};

/// Steps 1 to 5 of the paper's Figure 8 on one tree, again and again: a stage runs only where what
/// it depends on, its options, has changed since it last did.
class Stages {
 public:
  /// `run` must outlive it.
  explicit Stages(const Run& run) : run_(run) {}

  /// Prepares the tree with options that have an R_max. For an erosion, T leaves the share `below`
  /// of the leaves below it.
  /// @throws Error as grid_of and threshold_of do.
  Prepared prepare(const Options& resolved, double below);

  /// Returns dilation_of(), which is kept too.
  double dilation(const Prepared& prepared);

  /// Forgets all results, so that those that were handed out belong to their holders alone.
  void forget() { *this = Stages(run_); }

 private:
  struct DilationOptions {
    KernelsOptions kernels;
    double threshold;
    Hollows hollows;
    auto operator<=>(const DilationOptions&) const = default;
  };

  std::reference_wrapper<const Run> run_;
  Kept<PointsOptions, LeafPoints> points_;
  Kept<HashOptions, SpatialHash> hash_;
  Kept<DensityOptions, std::vector<float>> isotropic_density_;
  Kept<KernelsOptions, std::vector<Kernel>> kernels_;
  Kept<KernelsOptions, std::vector<float>> there_;  ///< N at the places on the leaves
  Kept<DilationOptions, double> dilation_;
};

}  // namespace leafhull
