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

/// Numbers from 0 in sets, each known by its lowest number whatever the order in which threads
/// unite: of two trees that meet, the root of the higher one comes under the other's.
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

  /// The lowest number of each one's set, once all are united.
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
