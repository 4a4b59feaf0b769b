// SPDX-License-Identifier: Apache-2.0
#include "tiles/scene_control.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>
#include <string>
#include <utility>
#include <vector>

#include "density/control.h"

namespace leafhull {
namespace {

/// Sums over densities N_iso that depend on neither their order nor who adds them.
class Moments {
 public:
  void add(const WeightedDensity& d) {
    const auto n = static_cast<std::int64_t>(std::llround(static_cast<double>(d.density) * kOne));
    const auto weight = static_cast<Wide>(d.weight);
    count_ += d.weight;
    sum_ += weight * n;
    squares_ += weight * n * n;
  }
  void add(const Moments& other) {
    count_ += other.count_;
    sum_ += other.sum_;
    squares_ += other.squares_;
  }
  double mean() const { return static_cast<double>(exact_mean() / kOne); }
  double variance() const {
    const long double mean_of_squares = static_cast<long double>(squares_) / count_;
    const long double variance = mean_of_squares - exact_mean() * exact_mean();
    return static_cast<double>(std::max(variance, 0.0L) / kOne / kOne);  // it may round below 0
  }

 private:
  static constexpr double kOne = 1 << 20;
  __extension__ using Wide = __int128;

  long double exact_mean() const { return static_cast<long double>(sum_) / count_; }

  std::uint64_t count_ = 0;
  Wide sum_ = 0, squares_ = 0;
};

/// Positive floats by their leading bits: 2^16 steps for each power of two.
class Histogram {
 public:
  Histogram() : counts_(kBins, 0) {}

  void add(const WeightedDensity& d) {
    const std::uint32_t bits = std::bit_cast<std::uint32_t>(std::max(d.density, 0.0f));
    counts_[bits < kFirst ? 0 : std::min((bits - kFirst) >> kDropped, kBins - 1)] += d.weight;
  }

  /// The highest lower end of a bin that has at least `share` of all at or above it.
  double quantile(double share) const { return end_of(bin_above(share, 1).first); }

  /// The same, to the nearest `unit`, the weight of a place on the leaves; where exactly that share
  /// lies above, halfway down to the next bin that is not empty, as in an extraction.
  double halfway_quantile(double share, std::uint64_t unit) const {
    const auto [bin, exact] = bin_above(share, unit);
    if (!exact) return end_of(bin);
    std::uint32_t next = bin;
    while (next > 0 && counts_[next - 1] == 0) --next;
    return next > 0 ? (end_of(bin) + end_of(next - 1)) / 2 : end_of(bin);
  }

  /// The lower end of the lowest bin with at least `share` of all in it or below.
  double not_exceeded_by(double share) const {
    std::uint64_t all = 0, up_to = 0;
    for (const std::uint64_t c : counts_) all += c;
    std::uint32_t bin = 0;
    for (; bin + 1 < kBins; ++bin) {
      up_to += counts_[bin];
      if (up_to > 0 && static_cast<double>(up_to) >= share * static_cast<double>(all)) break;
    }
    return end_of(bin);
  }

  std::span<std::uint64_t> counts() { return counts_; }

  /// The bins' lower ends and the weight in each, of places that are `in_solid` or not.
  std::vector<WeightedDensity> densities(bool in_solid) const {
    std::vector<WeightedDensity> all;
    for (std::uint32_t bin = 0; bin < kBins; ++bin) {
      if (counts_[bin] == 0) continue;
      all.push_back({std::bit_cast<float>(kFirst + (bin << kDropped)), counts_[bin], in_solid});
    }
    return all;
  }

  void add(const Histogram& other) {
    for (std::uint32_t bin = 0; bin < kBins; ++bin) counts_[bin] += other.counts_[bin];
  }

 private:
  /// The bin for `share`, and whether exactly that share lies in it and above.
  std::pair<std::uint32_t, bool> bin_above(double share, std::uint64_t unit) const {
    std::uint64_t all = 0;
    for (const std::uint64_t c : counts_) all += c;
    const double units = static_cast<double>(all) / static_cast<double>(unit);
    const auto wanted = static_cast<std::uint64_t>(std::llround(share * units)) * unit;
    std::uint64_t above = 0;
    std::uint32_t bin = kBins;
    while (bin > 0 && above < std::max<std::uint64_t>(wanted, 1)) above += counts_[--bin];
    return {bin, above == wanted};
  }
  static double end_of(std::uint32_t bin) {
    return static_cast<double>(std::bit_cast<float>(kFirst + (bin << kDropped)));
  }

  static constexpr std::uint32_t kDropped = 23 - 16;
  static constexpr std::uint32_t kFirst = (127u - 20) << 23;  // 2^-20
  static constexpr std::uint32_t kBins = (20u + 24) << 16;    // up to 2^24
  std::vector<std::uint64_t> counts_;
};

/// The sum of what the ranks have counted.
Moments together(const Moments& mine, Ranks& ranks) {
  Moments sum;
  for (const std::string& bytes : ranks.all({reinterpret_cast<const char*>(&mine), sizeof mine})) {
    Moments one;
    std::memcpy(&one, bytes.data(), sizeof one);
    sum.add(one);
  }
  return sum;
}

/// Visits the tiles, which the ranks take in turn.
template <class Visit>
void for_each_tile(const TilePlan& plan, Ranks& ranks, const TilesDone& advance, Visit&& visit) {
  ranks.reset();
  for (std::uint64_t t = ranks.next(); t < plan.size(); t = ranks.next()) {
    advance(t, plan.size());
    visit(t);
  }
}

/// T as the options ask, where the level's statistics are the scene's.
double threshold_of(const ForestLevel& level, const ForestLevel* finest, double mean) {
  const Options& options = level.options;
  if (options.threshold_percent) return *options.threshold_percent / 100 * mean;
  return finest ? *options.threshold * mean / finest->scene_statistics->mean : *options.threshold;
}

}  // namespace

void control_over_scene(const TilePlan& plan, const ForestLevel* finest, ForestLevel& level,
                        Device& device, Ranks& ranks, const TilesDone& advance) {
  Moments mine;
  Histogram isotropic;
  for_each_tile(plan, ranks, advance, [&](std::size_t t) {
    for (const WeightedDensity& n : isotropic_density_in(level, plan.task(t), device)) {
      mine.add(n);
      isotropic.add(n);
    }
  });
  const Moments moments = together(mine, ranks);
  ranks.sum(isotropic.counts());
  level.scene_statistics = band(
      moments.mean(), moments.variance(),
      [&](double share) { return isotropic.not_exceeded_by(share); },
      control_options(level.options));

  if (!level.options.coverage) {
    level.threshold = threshold_of(level, finest, moments.mean());
    return;
  }
  Histogram histogram, solids;
  for_each_tile(plan, ranks, advance, [&](std::size_t t) {
    for (const WeightedDensity& n : density_in(level, plan.task(t), device)) {
      (n.in_solid ? solids : histogram).add(n);
    }
  });
  ranks.sum(histogram.counts());
  ranks.sum(solids.counts());
  std::vector<WeightedDensity> densities = histogram.densities(false);
  for (const WeightedDensity& n : solids.densities(true)) densities.push_back(n);
  histogram.add(solids);
  if (level.options.points == PointSource::vertices) {
    level.threshold = histogram.quantile(*level.options.coverage);
    return;
  }
  const double coverage = *level.options.coverage;
  const std::uint64_t unit = weight_of(level.sample_unit, 1, level.sample_unit);
  level.threshold =
      clear_of_sheets(densities, histogram.halfway_quantile(coverage, unit), coverage);
}

}  // namespace leafhull
