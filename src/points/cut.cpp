// SPDX-License-Identifier: Apache-2.0
#include "points/cut.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numeric>
#include <tuple>

namespace leafhull {
namespace {

/// Rounds of Lloyd's method; more would gain little.
constexpr int kRounds = 6;

using Places = std::span<const Eigen::Vector2d>;

/// Calls visit(members) for each of `count` parts of about equal size.
template <class Visit>
void halve(Places samples, std::span<std::uint32_t> members, std::size_t count, Visit& visit) {
  if (members.empty()) return;
  if (count <= 1 || members.size() == 1) return visit(members);
  Eigen::Array2d low = samples[members.front()], high = low;
  for (const std::uint32_t i : members) {
    low = low.min(samples[i].array());
    high = high.max(samples[i].array());
  }
  const int axis = high[1] - low[1] > high[0] - low[0] ? 1 : 0;
  const std::size_t first = count / 2;
  const std::size_t cut = (members.size() * first + count / 2) / count;
  const auto key = [&](std::uint32_t i) {
    return std::tuple(samples[i][axis], samples[i][1 - axis], i);
  };
  std::ranges::nth_element(members, members.begin() + static_cast<std::ptrdiff_t>(cut), {}, key);
  halve(samples, members.first(cut), first, visit);
  halve(samples, members.subspan(cut), count - first, visit);
}

/// Finds the nearest of some seeds by a grid of cells.
class NearestSeed {
 public:
  /// `edge` of a cell is about the distance between seeds.
  NearestSeed(Places seeds, double edge) : seeds_(seeds), edge_(edge) {
    Eigen::Array2d high = seeds.front();
    low_ = high;
    for (const Eigen::Vector2d& seed : seeds) {
      low_ = low_.min(seed.array());
      high = high.max(seed.array());
    }
    for (int axis = 0; axis < 2; ++axis) size_[axis] = cell(high[axis], axis) + 1;
    first_.assign(static_cast<std::size_t>(size_[0]) * size_[1] + 1, 0);
    for (const Eigen::Vector2d& seed : seeds) ++first_[index(seed) + 1];
    std::partial_sum(first_.begin(), first_.end(), first_.begin());
    members_.resize(seeds.size());
    std::vector<std::uint32_t> next(first_.begin(), first_.end() - 1);
    for (std::uint32_t i = 0; i < seeds.size(); ++i) members_[next[index(seeds[i])]++] = i;
  }

  std::uint32_t operator()(const Eigen::Vector2d& p) const {
    std::uint32_t best = 0;
    double nearest = std::numeric_limits<double>::infinity();
    const int x = std::clamp(cell(p[0], 0), 0, size_[0] - 1);
    const int y = std::clamp(cell(p[1], 1), 0, size_[1] - 1);
    // The distance, in cells, from `p` to the side of its cell; negative outside the grid.
    const auto to_side = [&](int axis, int at) {
      const double into = (p[axis] - low_[axis]) / edge_ - at;
      return std::min(into, 1 - into);
    };
    const double to_sides = std::min(to_side(0, x), to_side(1, y));
    for (int ring = 0; ring < std::max(size_[0], size_[1]); ++ring) {
      const double least = std::max(ring - 1 + to_sides, 0.0) * edge_;  // to any seed in this ring
      if (ring > 0 && nearest <= least * least) break;
      for (int i = std::max(x - ring, 0); i <= std::min(x + ring, size_[0] - 1); ++i) {
        const bool side = i == x - ring || i == x + ring;
        const int step = side || ring == 0 ? 1 : 2 * ring;
        for (int j = y - ring; j <= y + ring; j += step) {
          if (j < 0 || j >= size_[1]) continue;
          const std::size_t c = static_cast<std::size_t>(i) * size_[1] + j;
          for (std::uint32_t m = first_[c]; m < first_[c + 1]; ++m) {
            const double distance = (seeds_[members_[m]] - p).squaredNorm();
            if (distance < nearest || (distance == nearest && members_[m] < best)) {
              nearest = distance;
              best = members_[m];
            }
          }
        }
      }
    }
    return best;
  }

 private:
  int cell(double v, int axis) const {
    return static_cast<int>(std::floor((v - low_[axis]) / edge_));
  }
  std::size_t index(const Eigen::Vector2d& p) const {
    return static_cast<std::size_t>(cell(p[0], 0)) * size_[1] + cell(p[1], 1);
  }

  Places seeds_;
  double edge_;
  Eigen::Array2d low_;
  std::array<int, 2> size_{};
  std::vector<std::uint32_t> first_, members_;
};

/// Sums over the samples that are nearest to a seed.
struct Sums {
  double count = 0;
  Eigen::Vector2d first = Eigen::Vector2d::Zero();
  Eigen::Matrix2d second = Eigen::Matrix2d::Zero();

  void add(const Eigen::Vector2d& p) {
    ++count;
    first += p;
    second += p * p.transpose();
  }
};

std::vector<Sums> sums_around(Places seeds, Places samples, double edge) {
  const NearestSeed nearest(seeds, edge);
  std::vector<Sums> sums(seeds.size());
  for (const Eigen::Vector2d& p : samples) {
    const std::uint32_t seed = nearest(p);
    sums[seed].add(p - seeds[seed]);
  }
  return sums;
}

/// The approximate distance between neighbouring seeds: the root of a part's area, estimated from
/// the box around the samples.
double spacing(Places samples, std::size_t count) {
  Eigen::Array2d low = samples.front(), high = low;
  for (const Eigen::Vector2d& p : samples) {
    low = low.min(p.array());
    high = high.max(p.array());
  }
  const Eigen::Array2d size = high - low;
  const double parts = static_cast<double>(count);
  const double edge = std::max(std::sqrt(size[0] * size[1] / parts), size.maxCoeff() / parts);
  return edge > 0 ? edge : 1;
}

}  // namespace

std::vector<FlatPart> cut_evenly(Places samples, std::size_t count) {
  std::vector<std::uint32_t> members(samples.size());
  std::iota(members.begin(), members.end(), 0u);
  std::vector<Eigen::Vector2d> seeds;
  const auto visit = [&](std::span<const std::uint32_t> part) {
    Eigen::Vector2d sum = Eigen::Vector2d::Zero();
    for (const std::uint32_t i : part) sum += samples[i];
    seeds.emplace_back(sum / static_cast<double>(part.size()));
  };
  halve(samples, members, count, visit);

  const double edge = spacing(samples, seeds.size());
  std::vector<Sums> sums = sums_around(seeds, samples, edge);
  for (int round = 0; round < kRounds && seeds.size() > 1; ++round) {
    for (std::size_t i = 0; i < seeds.size(); ++i) {
      if (sums[i].count > 0) seeds[i] += sums[i].first / sums[i].count;
    }
    sums = sums_around(seeds, samples, edge);
  }
  std::vector<FlatPart> parts;
  for (std::size_t i = 0; i < seeds.size(); ++i) {
    const auto& [number, first, second] = sums[i];
    if (number == 0) continue;
    const Eigen::Vector2d mean = first / number;
    parts.push_back({seeds[i] + mean, second / number - mean * mean.transpose(),
                     number / static_cast<double>(samples.size())});
  }
  return parts;
}

}  // namespace leafhull
