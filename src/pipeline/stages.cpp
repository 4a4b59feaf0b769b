// SPDX-License-Identifier: Apache-2.0
// The way from leaves to their abstract shape, stage by stage. Source: Figure 8, p. 53.
#include "pipeline/stages.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <exception>
#include <limits>
#include <string>
#include <utility>

#include "density/control.h"
#include "leafhull/error.h"
#include "pipeline/find_radius.h"
#include "pipeline/grid.h"
#include "pipeline/memory.h"
#include "surface/brick_mesher.h"
#include "surface/hollows.h"
#include "surface/metrics.h"

namespace leafhull {
namespace {

PointsKey points_key(const Report& report) {
  const Options& o = report.options;
  const bool area = o.points == PointSource::area;
  const double radius = area ? report.radius_max_model : 0;
  return {*o.points, radius * *o.point_spacing, radius};
}

DensityKey density_key(const Report& report) {
  const Options& o = report.options;
  const bool grid = o.density == DensitySource::grid;
  return {points_key(report), report.radius_max_model, o.falloff, o.density,
          grid ? report.voxel_size : 0};
}

KernelsKey kernels_key(const Report& report) {
  const Options& o = report.options;
  return {density_key(report),
          *o.method,
          *o.flatness,
          o.spread,
          {o.band_low, o.band_low_percent},
          {o.band_high, o.band_high_percent}};
}

Lattice lattice_of(const LeafSet& leaves, const Report& report) {
  return Lattice::near(leaves.crown.low, report.voxel_size);
}

std::vector<Vec3d> local(std::span<const Vec3d> places, const Lattice& lattice) {
  std::vector<Vec3d> points;
  points.reserve(places.size());
  for (const Vec3d& place : places) points.push_back(lattice.local(place));
  return points;
}

/// `Point` has a position.
template <class Point>
std::vector<Vec3d> positions_of(const std::vector<Point>& points) {
  std::vector<Vec3d> positions;
  positions.reserve(points.size());
  for (const Point& point : points) positions.push_back(point.position);
  return positions;
}

std::vector<WeightedDensity> weighted(std::span<const float> density,
                                      const std::vector<bool>& in_solid) {
  std::vector<WeightedDensity> all;
  all.reserve(density.size());
  for (std::size_t i = 0; i < density.size(); ++i) all.push_back({density[i], 1, in_solid[i]});
  return all;
}

/// T for a coverage.
double threshold_for(const Options& options, std::span<const float> density,
                     const std::vector<bool>& in_solid) {
  const double threshold = threshold_for_coverage(density, *options.coverage);
  if (options.points != PointSource::area) return threshold;
  std::vector<WeightedDensity> all = weighted(density, in_solid);
  return clear_of_sheets(all, threshold, *options.coverage);
}

double share_below(std::span<const float> density, double threshold) {
  const auto below =
      std::ranges::count_if(density, [&](float n) { return static_cast<double>(n) < threshold; });
  return static_cast<double>(below) / static_cast<double>(density.size());
}

/// Both sliders keep what was asked for within this.
constexpr double kSliderError = 0.01;

/// T that leaves the share `erosion` below it, for what the options ask.
/// @throws Error usage: no T does, or only one that tears a sheet.
double threshold_for_erosion(const Options& options, double erosion, std::span<const float> density,
                             const std::vector<bool>& in_solid) {
  const double threshold = threshold_for_coverage(density, 1 - erosion);
  char text[200];
  if (options.points == PointSource::area) {
    std::vector<WeightedDensity> all = weighted(density, in_solid);
    if (const std::optional<double> whole = below_film(all, threshold)) {
      std::snprintf(text, sizeof text,
                    "an erosion of %.3g cannot be had: most of this tree is sheets of one density, "
                    "%.3g, and a surface next to that is a film with holes; %.3g can",
                    *options.erosion, *whole / 0.6, share_below(density, *whole));
      throw Error(ErrorCode::usage, text, "Give that, or --coverage in place of --erosion.");
    }
  }
  const double below = share_below(density, threshold);
  const double with_equal = share_below(density, std::nextafter(threshold, HUGE_VAL));
  if (std::abs(below - erosion) > kSliderError) {
    std::snprintf(text, sizeof text,
                  "an erosion of %.3g cannot be had: many leaf vertices have the density %.4g; "
                  "about %.3g can, and %.3g",
                  *options.erosion, threshold, below, with_equal);
    throw Error(ErrorCode::usage, text, "Give one of these, or --points area.");
  }
  return threshold;
}

double threshold_of(const Options& options, const DensityStatistics& statistics,
                    std::span<const float> density, const std::vector<bool>& in_solid,
                    double erosion) {
  const double threshold =
      options.threshold           ? *options.threshold
      : options.threshold_percent ? *options.threshold_percent / 100 * statistics.mean
      : options.erosion           ? threshold_for_erosion(options, erosion, density, in_solid)
                                  : threshold_for(options, density, in_solid);
  if (threshold < static_cast<double>(std::numeric_limits<float>::min())) {
    throw Error(ErrorCode::usage, "the threshold T is too small for a density",
                "Raise --threshold to 1e-30 or more.");
  }
  return threshold;
}

/// Voxels along the crown grown by R_max where a dilation is counted. Source: p. 53.
constexpr int kDilationResolution = 64;

double dilation_voxel(const LeafSet& leaves, const Report& report) {
  return (leaves.crown.longest_side() + 2 * report.radius_max_model) / kDilationResolution;
}

double dilated_share(const Metrics& metrics) {
  const auto voxels = static_cast<double>(metrics.inside_voxels + metrics.on_voxels);
  return voxels == 0 ? 0 : static_cast<double>(metrics.dilated_voxels) / voxels;
}

/// A coverage is missed by more than this where many places have one density.
constexpr double kCoverageMissed = 0.025;

void warn_of_points(const LeafSet& leaves, const Options& options, std::span<const float> there,
                    const std::vector<bool>& in_solid, Report& report) {
  char text[240];
  if (options.points == PointSource::vertices &&
      leaves.mean_radius_major > report.radius_max_model) {
    std::snprintf(
        text, sizeof text,
        "the leaves' mean radius, %.3g model units, is above R_max, %.3g: kernels at their "
        "vertices leave their middle empty (--points area does not)",
        leaves.mean_radius_major, report.radius_max_model);
    report.warnings.emplace_back(text);
  }
  if (!options.coverage) return;
  // N is summed in floats: what lies this near to T may come out on either side on the lattice.
  const double above = report.threshold * (1 + 1e-5);
  const auto surely = std::count_if(there.begin(), there.end(),
                                    [&](float n) { return static_cast<double>(n) > above; });
  const double low = static_cast<double>(surely) / static_cast<double>(there.size());
  if (std::max(report.covered - *options.coverage, *options.coverage - low) <= kCoverageMissed) {
    return;
  }
  const auto in_solids = std::count(in_solid.begin(), in_solid.end(), true);
  if (2 * in_solids > std::ssize(in_solid)) return;  // filled out
  if (options.points == PointSource::area) {
    std::snprintf(
        text, sizeof text,
        "a coverage of %.3g cannot be had: most leaves are sheets of one density; T = %.3g, "
        "well below it, takes in %.0f%% of the leaf area",
        *options.coverage, report.threshold, 100 * report.covered);
  } else {
    std::snprintf(text, sizeof text,
                  "a coverage of %.3g cannot be had: many leaf vertices have the density %.4g, and "
                  "between %.0f%% and %.0f%% of all lie inside (--points area avoids that)",
                  *options.coverage, report.threshold, 100 * low, 100 * report.covered);
  }
  report.warnings.emplace_back(text);
}

/// More than these is no mass but crumbs.
constexpr std::uint64_t kManyPieces = 50;

void warn_of_pieces(std::uint64_t pieces, Report& report) {
  if (pieces <= kManyPieces) return;
  report.warnings.push_back("the shape falls into " + std::to_string(pieces) +
                            " pieces: raise --radius-max or --coverage to join them, or "
                            "--min-component to drop the small ones");
}

[[noreturn]] void refuse_erosion(double found, double asked) {
  char text[200];
  const bool too_much = found > asked;
  std::snprintf(text, sizeof text, "an erosion of %.3g cannot be had: %s %.3g outside", asked,
                too_much ? "pieces too small to be kept leave"
                         : "hollows that are filled hold leaves, which leaves",
                found);
  throw Error(ErrorCode::usage, text,
              too_much
                  ? "Give that, a larger --dilation or --radius-max, or a smaller --min-component."
                  : "Give that, or --hollows keep.");
}

[[noreturn]] void refuse_dilation(double found, const Options& options) {
  char text[200];
  std::snprintf(
      text, sizeof text,
      "a dilation of %.3g cannot be had on this tree: it goes %s to %.3g, with R_max %.3g "
      "crown units",
      *options.dilation, found < *options.dilation ? "up" : "down", found, *options.radius_max);
  throw Error(ErrorCode::usage, text, "Give that, or another --erosion.");
}

}  // namespace

FieldKey field_key(const Report& report) {
  const int margin = report.options.adaptivity > 0 ? 2 : 1;  // adaptive meshing looks further
  return {kernels_key(report), report.voxel_size, margin, report.options.dense};
}

/// N of `kernels`, summed there.
std::vector<float> Stages::density_at(std::span<const Vec3d> places, const Report& report,
                                      std::span<const Kernel> kernels) const {
  const Lattice lattice = leaf_lattice(leaves_, report.radius_max_model);
  DensityFunction density(device_, kernels, hash_.value, lattice, report.options.falloff);
  return density.at(local(places, lattice));
}

void Stages::prepare(Report& report) {
  const Options& options = report.options;
  sliders_ = {.finds_radius = options.dilation && !options.radius_max,
              .below = options.erosion.value_or(0),
              .low = 0,
              .high = 1};
  solve(report);
  if (!options.erosion) check_dilation(report);
}

void Stages::check_dilation(const Report& prepared) {
  const Options& options = prepared.options;
  if (!options.dilation) return;
  const double found = dilation(prepared);
  if (std::abs(found - *options.dilation) > kSliderError) refuse_dilation(found, options);
}

/// prepare_at() with R_max such that the dilation is as asked for, T leaving out `sliders_.below`.
void Stages::solve(Report& report) {
  if (!sliders_.finds_radius) return prepare_at(report);
  Options& options = report.options;
  const double crown_unit = leaves_.crown.longest_side() / kCrownUnits;
  const double start = radius_max_in_model_units(leaves_, options) / crown_unit;
  std::exception_ptr refusal;
  const auto dilation_at = [&](double radius) -> std::optional<double> {
    options.radius_max = radius;
    try {
      prepare_at(report);
    } catch (const Error& error) {  // no T has the erosion with this radius
      if (error.code() != ErrorCode::usage) throw;
      refusal = std::current_exception();
      return {};
    }
    return dilation(report);
  };
  const std::optional<RadiusFound> found = find_radius(*options.dilation, start, dilation_at);
  if (!found) std::rethrow_exception(refusal);
  // What is the nearest may be moved by an erosion yet.
  if (!found->reached) sliders_.finds_radius = false;
  if (options.radius_max != found->radius) (void)dilation_at(found->radius);
}

Stages::Surface Stages::surface(Report& prepared, Mesher mesher) {
  constexpr int kMostRounds = 8;
  for (int round = 1;; ++round) {
    sample(prepared, {prepared.threshold});
    Surface surface{take_field(prepared), {}};
    surface.polygons = polygonise(surface.field, mesher, prepared);
    if (!is_eroded(surface.field, round == kMostRounds, prepared)) continue;
    if (prepared.options.erosion) check_dilation(prepared);
    return surface;
  }
}

/// Whether a surface, polygonise() having told its pieces, has the erosion that is asked for. If
/// not, sets another T, and with a dilation another R_max: beside what T leaves out there are
/// pieces that are dropped, and what the lattice does not see.
bool Stages::is_eroded(const Field& field, bool is_last, Report& report) {
  constexpr double kLeast = 1e-3;  // of the leaves, below T
  if (!report.options.erosion) return true;
  const double asked = *report.options.erosion;
  const double missed = erosion(field, field.lattice(), dropped_cells_) - asked;
  if (std::abs(missed) <= 0.8 * kSliderError) return true;
  auto& [finds_radius, below, low, high] = sliders_;
  (missed > 0 ? high : low) = below;
  if (is_last || high - low < kLeast) {
    if (std::abs(missed) > kSliderError) refuse_erosion(asked + missed, asked);
    return true;
  }
  const double next = below - missed;
  below = low < next && next < high ? next : (low + high) / 2;
  solve(report);
  return false;
}

double Stages::erosion(const Field& field, const Lattice& lattice,
                       std::span<const Coord> dropped) const {
  return share_outside(field, local(points_.value.samples, lattice), dropped);
}

void Stages::prepare_at(Report& report) {
  const Options& options = report.options;
  report.device =
      device_.info().name + " (" + device_.info().platform + ", " + device_.info().variant + ")";
  report.warnings = leaves_.warnings;

  // Step 1: the grid.
  const Lattice lattice = set_grid(leaves_, report);
  const double radius_max = report.radius_max_model;

  const PointsKey key = points_key(report);
  watch_.start("points");
  points_.update(key, [&] {
    const auto& [source, spacing, radius] = key;
    return source == PointSource::area ? area_points(leaves_, spacing, radius)
                                       : vertex_points(leaves_);
  });
  const std::vector<LeafPoint>& points = points_.value.points;

  watch_.start("hash");
  hash_.update({key, radius_max}, [&] {
    return std::make_shared<const SpatialHash>(
        isotropic_kernels(points, radius_max, options.falloff), hash_cells(leaves_, radius_max));
  });

  // Step 2: the isotropic density at the leaf points, summed there or, as in the paper,
  // interpolated from the lattice.
  watch_.start("isotropic density");
  isotropic_density_.update(density_key(report), [&] {
    const std::vector<Kernel> kernels = isotropic_kernels(points, radius_max, options.falloff);
    const std::vector<Vec3d> places = positions_of(points);
    if (options.density == DensitySource::exact) return density_at(places, report, kernels);
    DensityFunction density(device_, kernels, hash_.value, lattice, options.falloff);
    return density.interpolated_at(local(places, lattice));
  });

  // Steps 3 to 5: p1 and p2, and from them the radii.
  watch_.start("control");
  report.density = density_statistics(points, isotropic_density_.value, leaves_.crown, options);
  kernels_.update(kernels_key(report), [&] {
    return controlled_kernels(points, isotropic_density_.value, report.density, radius_max,
                              options);
  });

  watch_.start("threshold");
  density_there_.update(kernels_key(report), [&] {
    const bool known = options.method == Method::isotropic &&
                       options.density == DensitySource::exact &&
                       options.points == PointSource::vertices && leaves_.stray_leaves == 0;
    return known ? isotropic_density_.value
                 : density_at(points_.value.samples, report, kernels_.value);
  });
  report.threshold = threshold_of(options, report.density, density_there_.value,
                                  points_.value.in_solid, sliders_.below);
  describe(report);
}

/// What is known of the leaves once T is.
void Stages::describe(Report& report) const {
  const Options& options = report.options;
  report.leaf_area = leaves_.area;
  report.leaf_colour = leaves_.colour;
  report.counts.leaves = leaves_.leaf_count;
  report.counts.leaf_vertices = leaves_.vertices.size();
  report.counts.leaf_points = points_.value.points.size();
  report.counts.dropped_leaves = leaves_.dropped_leaves;
  report.counts.split_components = leaves_.split_components;
  const std::vector<float>& there = density_there_.value;
  const auto off_site = std::count_if(there.begin(), there.end(), [&](float n) {
    return static_cast<double>(n) < report.threshold;
  });
  report.metrics.off_site_exact = static_cast<std::uint64_t>(off_site);
  report.covered = 1 - static_cast<double>(off_site) / static_cast<double>(there.size());
  warn_of_points(leaves_, options, there, points_.value.in_solid, report);
}

FieldMemory Stages::memory(const Report& prepared, const std::vector<double>& thresholds) {
  sampled_.forget();
  return {kernels_.value, hash_.value, leaves_.bounds, prepared, thresholds, available_memory()};
}

void Stages::sample(const Report& prepared, const std::vector<double>& thresholds) {
  watch_.start("field");
  const FieldKey key = field_key(prepared);
  sampled_.update({key, thresholds}, [&] {
    memory(prepared, thresholds).check();
    const auto& [kernels, voxel_size, margin, dense] = key;
    density_.emplace(device_, kernels_.value, hash_.value, lattice_of(leaves_, prepared),
                     prepared.options.falloff);
    auto [field, pairs, lists] = density_->sample_band(thresholds, margin, dense, lists_,
                                                       [&](double done) { watch_.advance(done); });
    return Sampled{std::move(field), pairs, std::make_shared<const BrickList>(std::move(lists))};
  });
}

Field Stages::field(const Report& prepared) const {
  return without_hollows(sampled_.value.field.at(prepared.threshold), prepared);
}

Field Stages::take_field(const Report& prepared) {
  sampled_.expire();
  return without_hollows(std::move(sampled_.value.field), prepared);
}

Field Stages::without_hollows(Field field, const Report& prepared) const {
  if (prepared.options.hollows == Hollows::keep) return field;
  watch_.start("hollows");
  return fill_hollows(std::move(field));
}

Polygons Stages::polygonise(const Field& field, Mesher mesher, Report& report) {
  watch_.start("polygonise");
  const Options& options = report.options;
  Polygons polygons = mesher == Mesher::bricks && options.adaptivity == 0
                          ? mesh_bricks(field)
                          : leafhull::polygonise(field, options.adaptivity);
  ComponentCount components = drop_small_components(polygons, *options.min_component);
  dropped_cells_ = std::move(components.dropped_cells);
  if (options.adaptivity > 0 && components.dropped > 0) {  // merged vertices leave cells out
    Polygons fine = mesh_bricks(field);
    dropped_cells_ = drop_small_components(fine, *options.min_component).dropped_cells;
  }
  report.counts.components = components.kept;
  warn_of_pieces(components.kept, report);
  report.counts.dropped_components = components.dropped;
  return polygons;
}

Metrics Stages::metrics_of(const Field& field, const Lattice& lattice, const Report& report) const {
  const bool area = report.options.points == PointSource::area;
  return leafhull::measure(
      field, local(points_.value.samples, lattice),
      area ? local(positions_of(leaves_.vertices), lattice) : std::vector<Vec3d>());
}

double Stages::dilation(const Report& prepared) {
  const Options& options = prepared.options;
  watch_.start("dilation");
  dilation_.update({kernels_key(prepared), prepared.threshold, *options.hollows}, [&] {
    const Lattice lattice = Lattice::near(leaves_.crown.low, dilation_voxel(leaves_, prepared));
    DensityFunction density(device_, kernels_.value, hash_.value, lattice, options.falloff);
    auto sampled =
        density.sample_band({prepared.threshold}, 1, false, Lists::forget, [](double) {});
    const bool fill = options.hollows == Hollows::fill;
    const Field field = fill ? fill_hollows(std::move(sampled.field)) : std::move(sampled.field);
    return dilated_share(metrics_of(field, lattice, prepared));
  });
  return dilation_.value;
}

void Stages::measure(const Field& field, Report& report) {
  watch_.start("metrics");
  const Lattice lattice = lattice_of(leaves_, report);
  const std::uint64_t off_site = report.metrics.off_site_exact;
  report.metrics = metrics_of(field, lattice, report);
  report.metrics.off_site_exact = off_site;
  const bool is_known = report.voxel_size == dilation_voxel(leaves_, report);
  report.metrics.dilation = is_known ? dilated_share(report.metrics) : dilation(report);
  report.metrics.erosion = erosion(field, lattice, dropped_cells_);
  report.counts.evaluated_voxels = field.sample_count();
  report.counts.evaluated_pairs = sampled_.value.pairs;
}

void Stages::refuse_empty(const Field& field, const Report& report) const {
  const Options& options = report.options;
  const auto at_leaves = std::max_element(density_there_.value.begin(), density_there_.value.end());
  char text[200];
  std::snprintf(text, sizeof text,
                "the surface is empty: no sample reaches the threshold %.4g, the density being at "
                "most %.4g at the leaves and between",
                field.threshold(), static_cast<double>(std::max(field.highest(), *at_leaves)));
  const char* lower = options.threshold           ? "Lower --threshold"
                      : options.threshold_percent ? "Lower --threshold-percent"
                      : options.erosion           ? "Lower --erosion"
                                                  : "Give --threshold 50% in place of --coverage";
  throw Error(ErrorCode::empty, text,
              std::string(lower) + ", enlarge --radius-max, or take a finer --resolution.");
}

}  // namespace leafhull
