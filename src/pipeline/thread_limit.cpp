// SPDX-License-Identifier: Apache-2.0
#include <tbb/global_control.h>

#include "leafhull/device.h"

namespace leafhull {

struct ThreadLimit::Control {
  explicit Control(int threads)
      : control(tbb::global_control::max_allowed_parallelism, static_cast<std::size_t>(threads)) {}
  tbb::global_control control;  ///< never moved, as TBB knows it by its address
};

ThreadLimit::ThreadLimit(int threads) {
  if (threads != 0) control_ = std::make_unique<Control>(threads);
}

ThreadLimit::~ThreadLimit() = default;

}  // namespace leafhull
