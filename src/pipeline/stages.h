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
#include "points/leaf_points.h"
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
    expire();
    value = Value();
  }

  /// Part of the value is being taken away: it is not handed out again.
  void expire() { key_.reset(); }

  Value value = Value();

 private:
  std::optional<Key> key_;
};

/// What the leaf points depend on: their kind, and of parts of area their spacing and R_max, model
/// units.
using PointsKey = std::tuple<PointSource, double, double>;
/// What N_iso depends on: the points, R_max, k, where it is taken, and the voxel size if from the
/// lattice.
using DensityKey = std::tuple<PointsKey, double, int, DensitySource, double>;
/// An end of the band as a deviation, or in percent of the leaves.
using BandEnd = std::tuple<std::optional<double>, std::optional<double>>;
/// What the kernels depend on: N_iso, the method, lambda_R, the spread, and the band's ends.
using KernelsKey = std::tuple<DensityKey, Method, double, Spread, BandEnd, BandEnd>;
/// What the field depends on beside T: the kernels, the voxel size, the margin, dense or not.
using FieldKey = std::tuple<KernelsKey, double, int, bool>;

/// Of a report with its options and grid set.
FieldKey field_key(const Report& report);

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
  /// of the grid, the density, T, the leaves and the device. Where the options ask for a dilation
  /// and have no R_max yet, finds and sets it.
  /// @throws Error usage: an erosion or a dilation that this tree cannot have.
  void prepare(Report& report);
  /// Whether the dilation that is asked for was found. prepare() sees to it, but with an erosion,
  /// which surface() may still correct.
  /// @throws Error usage: it was not.
  void check_dilation(const Report& prepared);

  /// What sample() would take, the last field given back.
  FieldMemory memory(const Report& prepared, const std::vector<double>& thresholds);

  /// Step 6, after prepare(): N where a surface can be, for all of `thresholds`, ascending.
  /// @throws Error usage where it does not fit in memory.
  void sample(const Report& prepared, const std::vector<double>& thresholds);

  /// The shape as step 7 takes it: what sample() has found, at the report's T, hollows filled where
  /// its options say so.
  Field field(const Report& prepared) const;
  /// The same without keeping what was sampled: nothing is held twice.
  Field take_field(const Report& prepared);

  /// Step 7: the surface of such a field, small components dropped, which sets
  /// their counts. No polygons where no sample reaches T. `mesher` is for surfaces without
  /// adaptivity; both give the same vertices and quads, in orders of their own.
  Polygons polygonise(const Field& field, Mesher mesher, Report& report);

  struct Surface {
    Field field;
    Polygons polygons;
  };
  /// sample(), take_field() and polygonise() for the report's T, and for another where its options
  /// ask for an erosion and this lattice shows one that is too far from it.
  /// @throws Error usage: as sample(); and where no T has that erosion.
  Surface surface(Report& prepared, Mesher mesher);

  /// The paper's metrics and the counts of a field, polygonise() having told its pieces.
  void measure(const Field& field, Report& report);

  /// Says why the surface is empty.
  [[noreturn]] void refuse_empty(const Field& field, const Report& report) const;

  /// Of the last sample().
  DensityFunction& density() { return *density_; }
  LeafPoints take_points() { return std::move(points_.value); }
  std::vector<Kernel> take_kernels() { return std::move(kernels_.value); }
  std::vector<float> take_density_there() { return std::move(density_there_.value); }
  std::vector<float> take_isotropic_density() { return std::move(isotropic_density_.value); }
  std::shared_ptr<const BrickList> lists() const { return sampled_.value.lists; }

 private:
  struct Sampled {
    Field field;
    std::uint64_t pairs = 0;
    std::shared_ptr<const BrickList> lists;
  };

  void prepare_at(Report& report);
  void solve(Report& report);
  /// Of a field of the report's tree.
  Metrics metrics_of(const Field& field, const Lattice& lattice, const Report& report) const;
  /// What Metrics says.
  double dilation(const Report& prepared);
  bool is_eroded(const Field& field, bool is_last, Report& report);
  double erosion(const Field& field, const Lattice& lattice, std::span<const Coord> dropped) const;

  std::vector<float> density_at(std::span<const Vec3d> places, const Report& report,
                                std::span<const Kernel> kernels) const;

  void describe(Report& report) const;
  Field without_hollows(Field field, const Report& prepared) const;

  const LeafSet& leaves_;
  Device& device_;
  Stopwatch& watch_;
  Lists lists_;
  Kept<PointsKey, LeafPoints> points_;
  Kept<std::tuple<PointsKey, double>, std::shared_ptr<const SpatialHash>> hash_;  ///< by R_max
  Kept<DensityKey, std::vector<float>> isotropic_density_;
  Kept<KernelsKey, std::vector<Kernel>> kernels_;
  Kept<KernelsKey, std::vector<float>> density_there_;  ///< N at the places on the leaves
  std::optional<DensityFunction> density_;
  Kept<std::tuple<FieldKey, std::vector<double>>, Sampled> sampled_;
  Kept<std::tuple<KernelsKey, double, Hollows>, double> dilation_;  ///< by T
  /// How far the search for an erosion and a dilation is.
  struct Sliders {
    bool finds_radius;
    double below;      ///< the share of the leaves that T leaves out
    double low, high;  ///< shares between which it lies
  } sliders_{};
  std::vector<Coord> dropped_cells_;  ///< of the last polygonise()
};

}  // namespace leafhull
