// SPDX-License-Identifier: Apache-2.0
#include "pipeline/sliders.h"

#include <cmath>
#include <exception>
#include <optional>
#include <utility>

#include "leafhull/error.h"
#include "pipeline/find_radius.h"
#include "pipeline/measure_shape.h"
#include "pipeline/threshold.h"
#include "text/numbers.h"

namespace leafhull {
namespace {

[[noreturn]] void refuse_erosion(double found, double asked) {
  const bool too_much = found > asked;
  throw Error(
      ErrorCode::usage,
      "an erosion of " + significant(asked, 3) + " cannot be reached: " +
          (too_much ? "pieces too small to be kept leave "
                    : "hollows that are filled hold leaves, which leaves ") +
          significant(found, 3) + " outside",
      too_much
          ? "Give that erosion, a larger --dilation or --radius-max, or a smaller --min-component."
          : "Give that erosion, or --hollows keep.");
}

[[noreturn]] void refuse_dilation(double found, const Options& options) {
  throw Error(ErrorCode::usage,
              "a dilation of " + significant(*options.dilation, 3) +
                  " cannot be reached on this tree: it goes " +
                  (found < *options.dilation ? "up to " : "down to ") + significant(found, 3) +
                  ", with R_max " + significant(*options.radius_max, 3) + " crown units",
              "Give that dilation, or another --erosion.");
}

}  // namespace

Sliders::Sliders(const Run& run, Stages& stages, Options resolved)
    : run_(run),
      stages_(stages),
      options_(std::move(resolved)),
      finds_radius_(options_.dilation && !options_.radius_max),
      below_(options_.erosion.value_or(0)) {}

Prepared Sliders::prepare() {
  Prepared prepared = solve();
  if (!options_.erosion) check_dilation(prepared);
  return prepared;
}

void Sliders::check_dilation(const Prepared& prepared) {
  if (!options_.dilation) return;
  const double found = stages_.dilation(prepared);
  if (std::abs(found - *options_.dilation) > kSliderError) refuse_dilation(found, options_);
}

/// Prepares with the R_max that gives the requested dilation, where T leaves out `below_`.
Prepared Sliders::solve() {
  if (!finds_radius_) return stages_.prepare(options_, below_);
  const double crown_unit = run_.leaves.crown.longest_side() / kCrownUnits;
  const double start = radius_max_in_model_units(run_.leaves, options_) / crown_unit;
  std::exception_ptr refusal;
  std::optional<Prepared> last;
  const auto dilation_at = [&](double radius) -> std::optional<double> {
    options_.radius_max = radius;
    last.reset();
    try {
      last = stages_.prepare(options_, below_);
    } catch (const Error& error) {  // no T has the erosion with this radius
      if (error.code() != ErrorCode::usage) throw;
      refusal = std::current_exception();
      return {};
    }
    return stages_.dilation(*last);
  };
  const std::optional<RadiusFound> found = find_radius(*options_.dilation, start, dilation_at);
  if (!found) std::rethrow_exception(refusal);
  // If no R_max has the dilation, the nearest is kept; the erosion may still move the dilation.
  if (!found->reached) finds_radius_ = false;
  if (options_.radius_max != found->radius) (void)dilation_at(found->radius);
  return std::move(last.value());
}

SampledSurface Sliders::surface(Prepared& prepared, DensityFunction::Lists lists) {
  constexpr int kMostRounds = 8;
  for (int round = 1;; ++round) {
    {
      SampledSurface surface{sample(run_, prepared, {prepared.threshold}, lists), {}};
      surface.sampled.field = without_hollows(run_, prepared, std::move(surface.sampled.field));
      surface.pieces = polygonise(run_, surface.sampled.field, prepared.options);
      if (is_eroded(prepared, surface, round == kMostRounds)) {
        if (options_.erosion) check_dilation(prepared);
        return surface;
      }
    }
    prepared = {};  // releases shared memory before the next one is made
    prepared = solve();
  }
}

/// Whether a surface has the requested erosion. If not, sets the share that T must leave out next:
/// dropped pieces and parts that the lattice does not resolve add to it.
bool Sliders::is_eroded(const Prepared& prepared, const SampledSurface& surface, bool is_last) {
  constexpr double kLeast = 1e-3;  // of the leaves, below T
  if (!options_.erosion) return true;
  const double asked = *options_.erosion;
  const double missed =
      erosion_of(prepared, surface.sampled.field, surface.pieces.dropped_cells) - asked;
  if (std::abs(missed) <= 0.8 * kSliderError) return true;
  (missed > 0 ? high_ : low_) = below_;
  if (is_last || high_ - low_ < kLeast) {
    if (std::abs(missed) > kSliderError) refuse_erosion(asked + missed, asked);
    return true;
  }
  const double next = below_ - missed;
  below_ = low_ < next && next < high_ ? next : (low_ + high_) / 2;
  return false;
}

}  // namespace leafhull
