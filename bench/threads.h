// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <tbb/global_control.h>

#include <memory>

namespace leafhull::bench {

/// Bounds TBB's threads while it lives; 0: all cores.
inline std::shared_ptr<const tbb::global_control> limit_threads(int threads) {
  if (threads == 0) return nullptr;
  return std::make_shared<tbb::global_control>(tbb::global_control::max_allowed_parallelism,
                                               static_cast<std::size_t>(threads));
}

}  // namespace leafhull::bench
