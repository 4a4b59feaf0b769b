// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <tbb/parallel_for.h>

#include <atomic>
#include <cstdint>
#include <numeric>
#include <tuple>
#include <utility>
#include <vector>

namespace leafhull {

/// Disjoint sets of numbers from 0. Each is known by its lowest number, in whatever order threads
/// unite sets: when two trees meet, the higher root is put under the lower one.
class DisjointSets {
 public:
  using Index = std::uint32_t;

  explicit DisjointSets(std::size_t count) : parent_(count) {
    std::iota(parent_.begin(), parent_.end(), Index{0});
  }

  void unite(Index a, Index b) {
    for (;;) {
      std::tie(a, b) = std::minmax({find(a), find(b)});
      if (a == b || parent(b).compare_exchange_strong(b, a)) return;
    }
  }

  /// The lowest number in the set of each number, after all sets are united.
  std::vector<Index> lowest() && {
    tbb::parallel_for(Index{0}, static_cast<Index>(parent_.size()),
                      [&](Index i) { parent(i).store(find(i), std::memory_order_relaxed); });
    return std::move(parent_);
  }

 private:
  std::atomic_ref<Index> parent(Index i) { return std::atomic_ref(parent_[i]); }

  Index find(Index i) {
    for (;;) {
      Index up = parent(i);
      const Index next = parent(up);
      if (up == next) return up;
      parent(i).compare_exchange_weak(up, next);  // another thread may have gone further
      i = next;
    }
  }

  std::vector<Index> parent_;
};

}  // namespace leafhull
