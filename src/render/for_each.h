// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <tbb/parallel_for.h>

#include <cstddef>

namespace leafhull::render {

/// Calls `function(i)` for all i below `count` on all threads; each takes `grain` at a time.
template <class Function>
void for_each(std::size_t count, std::size_t grain, Function&& function) {
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, count, grain), [&](const auto& some) {
    for (std::size_t i = some.begin(); i != some.end(); ++i) function(i);
  });
}

}  // namespace leafhull::render
