// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <tbb/enumerable_thread_specific.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <span>
#include <vector>

#include "density/descent.h"

namespace leafhull {

/// A batch is handed over at some 64 MiB of lists, or at 32 Ki bricks.
inline constexpr std::size_t kBatchEntries = std::size_t{1} << 24;
inline constexpr std::size_t kBatchBricks = std::size_t{1} << 15;

/// Searches `roots` in parallel, a group at a time, joins what was found in the order of the roots
/// and hands it to flush(found, done) on the calling thread whenever a batch is full, and at the
/// end. What is found has its `bricks`. The device works only while no search runs.
template <class Found, class Roots, class MakeDescent, class Search, class Join, class Flush>
void in_batches(const Roots& roots, MakeDescent&& make_descent, Search&& search, Join&& join,
                Flush&& flush) {
  tbb::enumerable_thread_specific<Descent> descents(make_descent);
  Found all;
  std::size_t group = 4;
  for (std::size_t begin = 0, end = 0; begin < roots.size(); begin = end) {
    end = std::min(begin + group, roots.size());
    std::vector<Found> found(end - begin);
    tbb::parallel_for(begin, end,
                      [&](std::size_t r) { search(descents.local(), roots[r], found[r - begin]); });
    std::size_t longest = 1;
    for (const Found& one : found) {
      join(all, one);
      longest = std::max(longest, one.bricks.kernels.size());
    }
    if (all.bricks.kernels.size() >= kBatchEntries || all.bricks.size() >= kBatchBricks) {
      flush(all, static_cast<double>(end) / static_cast<double>(roots.size()));
      all = Found{};
    }
    group = std::clamp<std::size_t>(kBatchEntries / longest, 1, 4 * group);
  }
  flush(all, 1.0);
}

}  // namespace leafhull
