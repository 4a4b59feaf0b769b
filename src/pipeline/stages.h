// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <vector>

#include "pipeline/prepared.h"
#include "pipeline/run.h"

namespace leafhull {

/// The last result of a stage, and the key that it was computed from.
template <class Key, class Value>
class Kept {
 public:
  /// Returns the last value if it has the same key, else computes one by `work`.
  template <class Work>
  std::shared_ptr<Value> get(const Key& key, Work&& work) {
    if (key_ != key) {
      forget();  // frees its memory before the next one is made
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

/// Runs steps 1 to 5 of the paper's Figure 8 on one tree repeatedly. A stage runs only if the
/// options that it depends on have changed since its last run.
class Stages {
 public:
  /// `run` must outlive it.
  explicit Stages(const Run& run) : run_(run) {}

  /// Prepares the tree with options that have an R_max. For an erosion, the share `below` of the
  /// leaves has a density below T. N_iso and N on the leaves are computed if kernels, T or the
  /// run's report depend on them.
  /// @throws Error as grid_of and threshold_of do.
  Prepared prepare(const Options& resolved, double below);

  /// Returns N at the places on the leaves, which is kept too.
  std::shared_ptr<std::vector<float>> there(const Prepared& prepared);

  /// Returns dilation_of(), which is kept too.
  double dilation(const Prepared& prepared);

  /// Forgets all results, so that results already returned have no other owner.
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
