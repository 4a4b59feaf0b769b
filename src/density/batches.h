// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <tbb/enumerable_thread_specific.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <span>
#include <vector>

#include "density/descent.h"

namespace leafhull {

/// Whether a batch is large enough to be handed over: some 64 MiB of lists, or 32 Ki bricks.
inline bool is_full(const BrickList& bricks) {
  return bricks.kernels.size() >= (std::size_t{1} << 24) || bricks.size() >= (std::size_t{1} << 15);
}

/// Root blocks to search before looking whether the batch is full: fewer where many kernels may
/// reach each of a root's 64 bricks.
inline std::size_t group_size(std::size_t kernels) {
  return std::clamp<std::size_t>((std::size_t{1} << 24) / (64 * kernels + 1), 1, 64);
}

/// Searches `roots` in parallel, `group` at a time, joins what was found in the order of the roots
/// and hands it to flush(found, done) on the calling thread whenever full(found), and at the end.
/// The device works only while no search runs.
template <class Found, class Roots, class MakeDescent, class Search, class Join, class Full,
          class Flush>
void in_batches(const Roots& roots, std::size_t group, MakeDescent&& make_descent, Search&& search,
                Join&& join, Full&& full, Flush&& flush) {
  tbb::enumerable_thread_specific<Descent> descents(make_descent);
  Found all;
  for (std::size_t begin = 0; begin < roots.size(); begin += group) {
    const std::size_t end = std::min(begin + group, roots.size());
    std::vector<Found> found(end - begin);
    tbb::parallel_for(begin, end,
                      [&](std::size_t r) { search(descents.local(), roots[r], found[r - begin]); });
    for (const Found& one : found) join(all, one);
    if (full(all)) {
      flush(all, static_cast<double>(end) / static_cast<double>(roots.size()));
      all = Found{};
    }
  }
  flush(all, 1.0);
}

}  // namespace leafhull
