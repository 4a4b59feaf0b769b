// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <numbers>

#include "checks.h"

namespace recount {
namespace {

/// How far the axes u, v, n are from a right-handed orthonormal frame.
double frame_error(const Point& u, const Point& v, const Point& n) {
  double error = std::max({std::abs(dot(u, v)), std::abs(dot(v, n)), std::abs(dot(n, u))});
  for (const Point& axis : {u, v, n}) error = std::max(error, std::abs(dot(axis, axis) - 1));
  const Point cross{n[1] * u[2] - n[2] * u[1], n[2] * u[0] - n[0] * u[2],
                    n[0] * u[1] - n[1] * u[0]};
  return std::max(error, std::abs(dot(cross, v) - 1));
}

void check_frames(const Extraction& extraction, Table& table) {
  const Ply& ply = extraction.kernels;
  const auto u = ply.points("ux", "uy", "uz"), v = ply.points("vx", "vy", "vz"),
             n = ply.points("nx", "ny", "nz");
  double worst = 0;
  for (std::size_t i = 0; i < ply.vertex_count; ++i) {
    worst = std::max(worst, frame_error(u[i], v[i], n[i]));
  }
  table.require("frame error, largest", worst, 0, 1e-5);
}

/// Checks radius units and presets. SPEC: 4 and 5.
void check_lengths(const Extraction& extraction, Table& table) {
  double longest = 0;
  for (const char* axis : {"x", "y", "z"}) {
    const auto& values = extraction.kernels.property(axis);
    const auto [low, high] = std::minmax_element(values.begin(), values.end());
    longest = std::max(longest, *high - *low);
  }
  const double radius = extraction.number("radius_max_model");
  const std::string unit = extraction.word("radius_unit");
  if (unit != "leaf") {
    const double expected =
        extraction.number("radius_max") * (unit == "crown" ? longest / 64 : 1.0);
    table.compare_near("radius_max_model", radius, expected, 1e-6 * expected);
  }
  const double cells = (longest + 2 * radius) / extraction.number("voxel_size");
  table.compare_near("resolution", extraction.number("resolution"), cells, 0.5);
}

/// The share of each kernel in sums over the leaves: its area, w pi R_u R_v / (k + 1), or one
/// vertex.
std::vector<double> shares(const Extraction& extraction) {
  const auto& ru = extraction.kernels.property("ru");
  std::vector<double> shares(ru.size(), 1.0);
  if (!extraction.by_area()) return shares;
  const auto &rv = extraction.kernels.property("rv"), &w = extraction.kernels.property("weight");
  const int falloff = extraction.parameter("falloff");
  for (std::size_t i = 0; i < shares.size(); ++i) {
    shares[i] = w[i] * std::numbers::pi * ru[i] * rv[i] / (falloff + 1);
  }
  return shares;
}

/// N_iso at each kernel. It counts layers of leaf, or leaf vertices, whose kernels have weight 1.
std::vector<double> isotropic_density(const Extraction& extraction) {
  const auto centres = extraction.kernels.points("x", "y", "z");
  const double radius = extraction.number("radius_max_model");
  const int falloff = extraction.parameter("falloff");
  const std::vector<double> share = shares(extraction);
  const double per_share =
      extraction.by_area() ? (falloff + 1) / (std::numbers::pi * radius * radius) : 1;
  std::vector<Kernel> kernels;
  for (std::size_t i = 0; i < centres.size(); ++i) {
    kernels.push_back(make_kernel(centres[i], {{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}},
                                  {radius, radius, radius}, per_share * share[i]));
  }
  std::vector<double> densities;
  if (extraction.word("density") == "grid") {
    const Lattice lattice = sum_on_lattice(kernels, falloff, extraction.number("voxel_size"));
    for (const Point& c : centres) densities.push_back(lattice.trilinear(c));
  } else {
    for (const Density& density : sum_at(centres, kernels, falloff)) {
      densities.push_back(density.value);
    }
  }
  return densities;
}

struct Band {
  double p1, p2;

  /// How much of the leaf's own radius Eq. (8) takes, from 0 (R_max) to 1 (R).
  double weight(double density) const {
    if (density <= p1) return 0;
    return density >= p2 ? 1 : (density - p1) / (p2 - p1);
  }
};

/// A number and its tolerance.
struct Expected {
  double value, error;
};

/// The density that a share of the leaves does not exceed. Where that share ends exactly at a leaf,
/// rounding may pick a neighbour in rank instead, and the tolerance allows for it.
Expected quantile(const std::vector<double>& densities, const std::vector<double>& share,
                  double percent) {
  std::vector<std::pair<double, double>> ranked;
  double all = 0;
  for (std::size_t i = 0; i < densities.size(); ++i) {
    ranked.emplace_back(densities[i], share[i]);
    all += share[i];
  }
  std::sort(ranked.begin(), ranked.end());
  const double wanted = percent / 100 * all;
  std::size_t at = 0;
  double before = 0, up_to = ranked[0].second;
  while (at + 1 < ranked.size() && up_to < wanted) {
    before = up_to;
    up_to += ranked[++at].second;
  }
  const auto is_end = [&](double sum) { return std::abs(sum - wanted) < kRounding * all; };
  const double value = ranked[at].first;
  double error = kRounding * value;
  if (at > 0 && is_end(before)) error += value - ranked[at - 1].first;
  if (at + 1 < ranked.size() && is_end(up_to)) error += ranked[at + 1].first - value;
  return {value, error};
}

/// Checks Eqs. (9) and (10), or the shares of the leaves. The tolerances follow from each N_iso
/// being known to kRounding.
Band check_statistics(const Extraction& extraction, const std::vector<double>& densities,
                      Table& table) {
  const auto& stored = extraction.kernels.property("density");
  const std::vector<double> share = shares(extraction);
  double worst = 0, all = 0, mean = 0, variance = 0;
  for (const double s : share) all += s;
  for (std::size_t i = 0; i < densities.size(); ++i) {
    worst = std::max(worst, std::abs(stored[i] - densities[i]) / densities[i]);
    mean += densities[i] * share[i] / all;
  }
  for (std::size_t i = 0; i < densities.size(); ++i) {
    variance += (densities[i] - mean) * (densities[i] - mean) * share[i] / all;
  }
  const double mean_error = kRounding * mean;
  const double spread_error = kRounding * std::sqrt(mean * mean + variance);
  const double variance_error = spread_error * (2 * std::sqrt(variance) + spread_error);
  const bool by_variance = extraction.word("spread") == "variance";
  double spread = by_variance ? variance : std::sqrt(variance);
  if (extraction.by_area()) spread = std::max(spread, 0.15 * mean);  // SPEC: 3
  const auto end = [&](const std::string& name) -> Expected {
    const auto& percent = extraction.parameter(name + "_percent");
    if (!percent.is_null()) return quantile(densities, share, percent);
    const double a = extraction.number(name);
    return {mean + a * spread,
            mean_error + std::abs(a) * (by_variance ? variance_error : spread_error)};
  };
  Expected p1 = end("band_low"), p2 = end("band_high");
  if (extraction.by_area() && !extraction.parameter("band_low_percent").is_null() &&
      !extraction.parameter("band_high_percent").is_null()) {  // SPEC: 3
    const double missing = std::max(0.0, 0.3 * mean - (p2.value - p1.value));
    p1.value -= missing / 2;
    p2.value += missing / 2;
    p1.error = p2.error = std::max(p1.error, p2.error);
  }
  const auto& report = extraction.report.at("density");
  // The file rounds leaf points and their weights, unlike leaf vertices, to floats.
  table.require("N_iso, largest relative error", worst, 0,
                extraction.by_area() ? 5 * kRounding : kRounding);
  table.compare_near("density mean", report.at("mean"), mean, mean_error);
  table.compare_near("density variance", report.at("variance"), variance, variance_error);
  table.compare_near("p1", report.at("p1"), p1.value, p1.error);
  table.compare_near("p2", report.at("p2"), p2.value, p2.error);
  const auto& percent = extraction.parameter("threshold_percent");
  if (!percent.is_null()) {
    const double threshold = percent.get<double>() / 100 * mean;
    table.compare_near("threshold by percent", extraction.number("threshold"), threshold,
                       kRounding * threshold);
  }
  return {p1.value, p2.value};
}

/// Checks each kernel's radii against its method. Rounding of N_iso makes Eq. (8)'s weight a range.
class RadiusCheck {
 public:
  RadiusCheck(const Extraction& extraction, Band band, const std::vector<double>& densities)
      : method_(extraction.word("method")),
        band_(band),
        densities_(densities),
        radius_max_(extraction.number("radius_max_model")),
        flatness_(method_ == "isotropic" ? 1 : extraction.number("flatness")),
        ru_(extraction.kernels.property("ru")),
        rv_(extraction.kernels.property("rv")),
        rn_(extraction.kernels.property("rn")) {}

  /// Eq. (8) scales all axes alike, so R_u >= R_v and Eq. (7) show in the radii used.
  std::size_t count_off_method() const {
    return count([&](std::size_t i) {
      const auto [low, high] = weights(i);
      if (high == 0) {
        return is_radius_max(ru_[i]) && is_radius_max(rv_[i]) && is_radius_max(rn_[i]);
      }
      // If a leaf is wider than R_max, the width used is only a lower bound of R_v.
      const double high_rn = is_radius_max(rv_[i]) ? radius_max_ : normal_radius(rv_[i], high);
      return ru_[i] >= rv_[i] - rounding() &&
             (is_between(rn_[i], normal_radius(rv_[i], low), high_rn) ||
              is_between(rn_[i], normal_radius(rv_[i], high), high_rn));
    });
  }

  /// Checks Eq. (8) itself with the leaves' own radii.
  std::size_t count_off_equation_8(const Ply& leaf_kernels) const {
    const auto &leaf_u = leaf_kernels.property("ru"), &leaf_v = leaf_kernels.property("rv");
    return count([&](std::size_t i) {
      const auto [low, high] = weights(i);
      return is_between(ru_[i], used_radius(leaf_u[i], low), used_radius(leaf_u[i], high)) &&
             is_between(rv_[i], used_radius(leaf_v[i], low), used_radius(leaf_v[i], high));
    });
  }

 private:
  template <class Holds>
  std::size_t count(Holds holds) const {
    std::size_t exceptions = 0;
    for (std::size_t i = 0; i < densities_.size(); ++i) exceptions += !holds(i);
    return exceptions;
  }

  std::pair<double, double> weights(std::size_t i) const {
    if (method_ == "isotropic") return {0, 0};
    if (method_ == "uncontrolled") return {1, 1};
    return {band_.weight(densities_[i] * (1 - kRounding)),
            band_.weight(densities_[i] * (1 + kRounding))};
  }

  double used_radius(double leaf_radius, double weight) const {
    return within_bounds(radius_max_ + (leaf_radius - radius_max_) * weight);
  }
  /// Eq. (7) after Eq. (8): r_n - b = lambda (r_v - b), where b is the part of R_max in both.
  double normal_radius(double minor_radius, double weight) const {
    const double shared = radius_max_ * (1 - weight);
    return within_bounds(shared + flatness_ * (minor_radius - shared));
  }
  /// The bounds of SPEC: 1 and 1b.
  double within_bounds(double radius) const {
    return std::clamp(radius, 1e-3 * radius_max_, radius_max_);
  }

  double rounding() const { return kRounding * radius_max_; }
  bool is_radius_max(double radius) const { return is_between(radius, radius_max_, radius_max_); }
  bool is_between(double radius, double a, double b) const {
    return radius >= std::min(a, b) - rounding() && radius <= std::max(a, b) + rounding();
  }

  std::string method_;
  Band band_;
  const std::vector<double>& densities_;
  double radius_max_, flatness_;
  const std::vector<double>&ru_, &rv_, &rn_;
};

void check_radii(const Extraction& extraction, Band band, const std::vector<double>& densities,
                 Table& table) {
  const RadiusCheck check(extraction, band, densities);
  table.require("kernels off Eqs. 7 and 8", double(check.count_off_method()), 0, 0);
  if (extraction.leaf_kernels) {
    table.require("kernels off Eq. 8 by leaf radii",
                  double(check.count_off_equation_8(*extraction.leaf_kernels)), 0, 0);
  }
}

}  // namespace

void check_kernels(const Extraction& extraction, Table& table) {
  const double count = double(extraction.kernels.vertex_count);
  const auto& counts = extraction.report.at("counts");
  table.compare("leaf points", counts.at("leaf_points"), count, count, count);
  check_frames(extraction, table);
  if (extraction.by_area()) {
    double area = 0;
    for (const double share : shares(extraction)) area += share;
    table.compare_near("leaf area", counts.at("leaf_area"), area, 1e-6 * area);
  } else {
    check_lengths(extraction, table);  // needs the crown of the leaf vertices
  }
  const std::vector<double> densities = isotropic_density(extraction);
  const Band band = check_statistics(extraction, densities, table);
  check_radii(extraction, band, densities, table);
}

}  // namespace recount
