// SPDX-License-Identifier: Apache-2.0
#include "forest/scene_control.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>
#include <string>
#include <vector>

#include "density/control.h"

namespace leafhull {
namespace {

/// Count, mean and squared deviations of a tile's densities.
struct Moments {
  std::uint64_t tile = 0;
  double count = 0, mean = 0, deviations = 0;
};

Moments moments_of(std::uint64_t tile, std::span<const float> densities) {
  Moments m{.tile = tile, .count = static_cast<double>(densities.size())};
  if (densities.empty()) return m;
  for (const float n : densities) m.mean += static_cast<double>(n);
  m.mean /= m.count;
  for (const float n : densities) {
    const double d = static_cast<double>(n) - m.mean;
    m.deviations += d * d;
  }
  return m;
}

/// Source: Chan, Golub and LeVeque, "Updating Formulae and a Pairwise Algorithm for Computing
/// Sample Variances", 1979.
Moments together(const Moments& a, const Moments& b) {
  if (a.count == 0) return b;
  if (b.count == 0) return a;
  const double count = a.count + b.count, apart = b.mean - a.mean;
  return {.tile = 0,
          .count = count,
          .mean = a.mean + apart * b.count / count,
          .deviations = a.deviations + b.deviations + apart * apart * a.count * b.count / count};
}

/// Positive floats by their leading bits: 2^16 steps for each power of two.
class Histogram {
 public:
  Histogram() : counts_(kBins, 0) {}

  void add(float density) {
    const std::uint32_t bits = std::bit_cast<std::uint32_t>(std::max(density, 0.0f));
    ++counts_[bits < kFirst ? 0 : std::min((bits - kFirst) >> kDropped, kBins - 1)];
  }

  /// The highest lower end of a bin that has at least `share` of all at or above it.
  double quantile(double share) const {
    std::uint64_t all = 0;
    for (const std::uint64_t c : counts_) all += c;
    const auto wanted = static_cast<std::uint64_t>(std::llround(share * static_cast<double>(all)));
    std::uint64_t above = 0;
    std::uint32_t bin = kBins;
    while (bin > 0 && above < std::max<std::uint64_t>(wanted, 1)) above += counts_[--bin];
    return static_cast<double>(std::bit_cast<float>(kFirst + (bin << kDropped)));
  }

  std::span<std::uint64_t> counts() { return counts_; }

 private:
  static constexpr std::uint32_t kDropped = 23 - 16;
  static constexpr std::uint32_t kFirst = (127u - 20) << 23;  // 2^-20
  static constexpr std::uint32_t kBins = (20u + 24) << 16;    // up to 2^24
  std::vector<std::uint64_t> counts_;
};

template <class T>
std::string bytes_of(std::span<const T> values) {
  return {reinterpret_cast<const char*>(values.data()), values.size_bytes()};
}

template <class T>
void append(std::vector<T>& values, const std::string& bytes) {
  const std::size_t before = values.size();
  values.resize(before + bytes.size() / sizeof(T));
  if (!bytes.empty()) std::memcpy(values.data() + before, bytes.data(), bytes.size());
}

/// The ranks take tiles in turn.
template <class Visit>
void for_each_tile(const TilePlan& plan, Ranks& ranks, const TilesDone& advance, Visit&& visit) {
  ranks.reset();
  for (std::uint64_t t = ranks.next(); t < plan.size(); t = ranks.next()) {
    advance(t, plan.size());
    visit(t);
  }
}

/// T for what the options ask, the level's statistics being those of the scene.
double threshold_of(const ForestLevel& level, const ForestLevel* finest, double mean) {
  const Options& options = level.options;
  if (options.threshold_percent) return *options.threshold_percent / 100 * mean;
  return finest ? *options.threshold * mean / finest->scene_statistics->mean : *options.threshold;
}

}  // namespace

void control_over_scene(const Scene& scene, const TilePlan& plan, int edge,
                        const ForestLevel* finest, ForestLevel& level, Device& device, Ranks& ranks,
                        const TilesDone& advance) {
  const auto task = [&](std::size_t t) { return TileTask{plan.tiles()[t], edge, plan.trees(t)}; };
  std::vector<Moments> parts;
  for_each_tile(plan, ranks, advance, [&](std::size_t t) {
    parts.push_back(moments_of(t, isotropic_density_in(scene, level, task(t), device)));
  });
  std::vector<Moments> all;
  for (const std::string& bytes : ranks.all(bytes_of(std::span<const Moments>(parts)))) {
    append(all, bytes);
  }
  std::sort(all.begin(), all.end(),
            [](const Moments& a, const Moments& b) { return a.tile < b.tile; });
  Moments sum;
  for (const Moments& part : all) sum = together(sum, part);
  level.scene_statistics = band(sum.mean, sum.deviations / sum.count, level.options);

  if (!level.options.coverage) {
    level.threshold = threshold_of(level, finest, sum.mean);
    return;
  }
  Histogram histogram;
  for_each_tile(plan, ranks, advance, [&](std::size_t t) {
    for (const float n : density_in(scene, level, task(t), device)) histogram.add(n);
  });
  const std::vector<std::string> counts =
      ranks.all(bytes_of(std::span<const std::uint64_t>(histogram.counts())));
  std::fill(histogram.counts().begin(), histogram.counts().end(), 0);
  for (const std::string& bytes : counts) {
    std::vector<std::uint64_t> part;
    append(part, bytes);
    for (std::size_t i = 0; i < part.size(); ++i) histogram.counts()[i] += part[i];
  }
  level.threshold = histogram.quantile(*level.options.coverage);
}

}  // namespace leafhull
