// SPDX-License-Identifier: Apache-2.0
#include "study/band_study.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <optional>

#include "study/numbers.h"
#include "study/study_plan.h"

namespace leafhull {
namespace {

/// The search for a share ends within kClose of it; ending beyond kCloseEnough, it has failed.
constexpr double kClose = 1e-4, kCloseEnough = 1e-3;
/// It also ends when the value is known to this relative precision: the share jumps there.
constexpr double kSameValue = 1e-4;
constexpr int kMostProbes = 24;
/// How far a search goes from its start, as a factor up or down.
constexpr double kReach = 16;

constexpr int kBandWidth = 20, kBandStep = 10;  // percent of the leaf vertices
constexpr Band kDeviations[] = {{0, 2}, {-0.5, 0}, {-1, -0.5}};

/// A value and the share of the leaf vertices that is lost with it.
struct Probe {
  double value = 0, share = 0;
};

/// Finds the value whose share is `wanted`, else the nearest one; `share_at` rises with the value.
Probe search(double wanted, double start, const std::function<double(double)>& share_at) {
  std::optional<Probe> below, above, best;
  double value = start;
  for (int i = 0; i < kMostProbes; ++i) {
    const Probe here{value, share_at(value)};
    const auto missing = [&](const Probe& probe) { return std::abs(probe.share - wanted); };
    if (!best || missing(here) < missing(*best)) best = here;
    if (missing(here) <= kClose) break;
    (here.share < wanted ? below : above) = here;
    if (below && above) {
      if (above->value < below->value * (1 + kSameValue)) break;
      // Alternate between interpolation and bisection: the share may be far from linear.
      const double part = (wanted - below->share) / (above->share - below->share);
      const double step = i % 2 == 0 ? 0.5 : std::clamp(part, 0.05, 0.95);
      value = below->value * std::pow(above->value / below->value, step);
    } else {
      value *= below ? 2 : 0.5;
      if (value > start * kReach || value < start / kReach) break;
    }
  }
  return *best;
}

/// Whether a probe is close enough. One vertex of a small tree may be more than kCloseEnough.
bool is_reached(const Probe& probe, double wanted, const LeafSet& leaves) {
  const double one = 1 / static_cast<double>(leaves.vertices.size());
  return std::abs(probe.share - wanted) <= std::max(kCloseEnough, one);
}

/// The share of leaf vertices that a method loses in the paper's Table 1.
double share_in_paper(Method method) {
  const StudyRow& row = paper_results().table1[static_cast<std::size_t>(method)];
  return share_lost(row, kPaperLeafVertices);
}

/// The share of leaf vertices that a row's method loses on this tree.
double measured_share(StudyRow row, const LeafSet& leaves, Device& device) {
  const Plan plan{{options_of(row, kBandReading)}, {{&row}}};
  measure(plan, leaves, device, [](const Report&) {});
  return share_lost(row, leaves.vertices.size());
}

/// Scales leaves as `--leaf-scale` does, in addition to it.
LeafSet scaled(LeafSet leaves, double scale) {
  for (LeafVertex& vertex : leaves.vertices) {
    vertex.radius_major *= static_cast<float>(scale);
    vertex.radius_minor *= static_cast<float>(scale);
  }
  leaves.mean_radius_major *= scale;
  return leaves;
}

std::string failure(Method method, const char* parameter, const Probe& nearest, double value) {
  return std::string(paper_name(method)) + " loses " + fixed(100 * nearest.share, 2) +
         "% of the leaf vertices where it comes nearest to the paper’s " +
         fixed(100 * share_in_paper(method), 2) + "%, " + parameter + " being " +
         significant(value, 4);
}

/// Finds the T at which L&D loses the same share as in the paper. The search starts at the T that
/// N, summed at the leaf vertices, suggests.
void fit_threshold(BandStudy& band, const LeafSet& leaves, Device& device) {
  const double wanted = share_in_paper(Method::isotropic);
  StudyRow& row = band.isotropic;
  Options first = options_of(row, kBandReading);
  first.threshold.reset();
  first.coverage = 1 - wanted;
  double start = 0;
  measure({{first}, {{}}}, leaves, device, [&](const Report& report) {
    start = report.threshold;
    band.evenness = std::sqrt(report.density.variance) / report.density.mean;
  });
  const Probe found = search(wanted, start, [&](double threshold) {
    row.threshold = threshold;
    return measured_share(row, leaves, device);
  });
  row.threshold = band.threshold = found.value;
  if (!is_reached(found, wanted, leaves)) {
    band.failure = failure(row.method, "T", found, found.value);
  }
}

/// Finds the leaf scale at which UNCTRLED loses the same share as in the paper, at the same T.
void fit_leaf_scale(BandStudy& band, const LeafSet& leaves, Device& device) {
  const double wanted = share_in_paper(Method::uncontrolled);
  StudyRow& row = band.uncontrolled;
  row.threshold = band.threshold;
  const Probe found = search(wanted, 1, [&](double smaller) {
    return measured_share(row, scaled(leaves, 1 / smaller), device);
  });
  band.leaf_scale = 1 / found.value;
  if (!is_reached(found, wanted, leaves)) {
    band.failure = failure(row.method, "the leaf scale", found, band.leaf_scale);
  }
}

Options options_of(const BandRow& row) {
  Options options = options_of(row.row, kBandReading);
  const Band& band = row.band;
  (band.percent ? options.band_low_percent : options.band_low) = band.low;
  (band.percent ? options.band_high_percent : options.band_high) = band.high;
  return options;
}

void move_band(BandStudy& band, const LeafSet& leaves, Device& device) {
  StudyRow controlled = band.uncontrolled;
  controlled.method = Method::controlled;
  for (int low = 100 - kBandWidth; low >= 0; low -= kBandStep) {
    const auto share = static_cast<double>(low);
    band.by_share.push_back({{share, share + kBandWidth, true}, controlled});
  }
  for (const Band& deviations : kDeviations) band.by_deviation.push_back({deviations, controlled});

  Plan plan;
  for (StudyRow* end : {&band.isotropic, &band.uncontrolled}) {
    plan.options.push_back(options_of(*end, kBandReading));
    plan.rows.push_back({end});
  }
  for (auto* rows : {&band.by_share, &band.by_deviation}) {
    for (BandRow& row : *rows) {
      plan.options.push_back(options_of(row));
      plan.rows.push_back({&row.row});
    }
  }
  measure(plan, scaled(leaves, band.leaf_scale), device, [](const Report&) {});
}

}  // namespace

std::string name(const Band& band) {
  const std::string low = significant(band.low, 4), high = significant(band.high, 4);
  return band.percent ? low + "–" + high + "%" : low + " to " + high + " s";
}

double share_lost(const StudyRow& row, std::uint64_t leaf_vertices) {
  return static_cast<double>(row.off_site()) / static_cast<double>(leaf_vertices);
}

double share_dilated(const StudyRow& row, const StudyRow& isotropic) {
  return static_cast<double>(row.metrics.dilated_voxels) /
         static_cast<double>(isotropic.metrics.dilated_voxels);
}

BandStudy study_band(const LeafSet& leaves, Device& device) {
  BandStudy band;
  const ReadingStudy plan = planned(kBandReading);
  band.isotropic = plan.table1[static_cast<std::size_t>(Method::isotropic)];
  band.uncontrolled = plan.table1[static_cast<std::size_t>(Method::uncontrolled)];
  fit_threshold(band, leaves, device);
  if (band.failure.empty()) fit_leaf_scale(band, leaves, device);
  if (band.failure.empty()) move_band(band, leaves, device);
  return band;
}

}  // namespace leafhull
