// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "leafhull/shape.h"
#include "pipeline/evaluate.h"
#include "pipeline/memory.h"
#include "pipeline/stopwatch.h"
#include "surface/components.h"
#include "surface/polygonise.h"

namespace leafhull {

/// A result and what it was computed from.
template <class Key, class Value>
class Kept {
 public:
  /// Computes the value by `work` unless the last one was for the same key.
  template <class Work>
  void update(const Key& key, Work&& work) {
    if (key_ == key) return;
    forget();  // gives its memory back before the next is made
    value = work();
    key_ = key;
  }

  void forget() {
    key_.reset();
    value = Value();
  }

  Value value{};

 private:
  std::optional<Key> key_;
};

/// What N_iso depends on: R_max, k, where it is taken, and the voxel size if from the lattice.
using DensityKey = std::tuple<double, int, DensitySource, double>;
/// What the kernels depend on: N_iso, the method, lambda_R, the spread, a1 and a2.
using KernelsKey = std::tuple<DensityKey, Method, double, Spread, double, double>;
/// What the field depends on beside T: the kernels, the voxel size, the margin, dense or not.
using FieldKey = std::tuple<KernelsKey, double, int, bool>;

/// Of a report with its options and grid set.
FieldKey field_key(const Report& report);

/// Of values at the leaf vertices those in the crown: strays decide neither control nor T.
std::vector<float> in_crown(const LeafSet& leaves, std::vector<float> values);

/// The stages of the paper's Figure 8 on one tree. Each keeps its last result and works again only
/// where what it depends on has changed.
class Stages {
 public:
  using Lists = DensityFunction::Lists;

  /// All three must outlive it, but for what it hands out. `lists`: of the kernels near each brick
  /// of a field, for rays.
  Stages(const LeafSet& leaves, Device& device, Stopwatch& watch, Lists lists = Lists::forget)
      : leaves_(leaves), device_(device), watch_(watch), lists_(lists) {}

  /// Steps 1 to 5 for the report's options, which are resolved, and T: sets what the report says
  /// of the grid, the density, T, the leaves and the device.
  void prepare(Report& report);

  /// What sample() would take, the last field given back.
  FieldMemory memory(const Report& prepared, const std::vector<double>& thresholds);

  /// Step 6, after prepare(): N where a surface can be, for all of `thresholds`, ascending.
  /// @throws Error usage where it does not fit in memory.
  const Field& sample(const Report& prepared, const std::vector<double>& thresholds);

  /// Step 7: the surface of a field that sample() returned, small components dropped, which sets
  /// their counts. No polygons where no sample reaches T. `mesher` is for surfaces without
  /// adaptivity; both give the same vertices and quads, in orders of their own.
  Polygons polygonise(const Field& field, Mesher mesher, Report& report) const;

  /// The paper's metrics and the counts of a field.
  void measure(const Field& field, Report& report) const;

  /// Says why the surface is empty.
  [[noreturn]] void refuse_empty(const Field& field, const Report& report) const;

  /// Of the last sample().
  DensityFunction& density() { return *density_; }
  std::vector<Kernel> take_kernels() { return std::move(kernels_.value); }
  std::vector<float> take_density_there() { return std::move(density_there_.value); }
  std::vector<float> take_isotropic_density() { return std::move(isotropic_density_.value); }
  std::shared_ptr<const Field> field() const { return sampled_.value.field; }
  std::shared_ptr<const BrickList> lists() const { return sampled_.value.lists; }

 private:
  struct Sampled {
    std::shared_ptr<const Field> field;
    std::uint64_t pairs = 0;
    std::shared_ptr<const BrickList> lists;
  };

  std::vector<float> density_at_leaves(const Report& report, std::span<const Kernel> kernels) const;

  const LeafSet& leaves_;
  Device& device_;
  Stopwatch& watch_;
  Lists lists_;
  Kept<double, std::shared_ptr<const SpatialHash>> hash_;  ///< by R_max
  Kept<DensityKey, std::vector<float>> isotropic_density_;
  Kept<KernelsKey, std::vector<Kernel>> kernels_;
  Kept<KernelsKey, std::vector<float>> density_there_;  ///< N at the leaf vertices
  std::optional<DensityFunction> density_;
  Kept<std::tuple<FieldKey, std::vector<double>>, Sampled> sampled_;
};

}  // namespace leafhull
