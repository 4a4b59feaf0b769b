// SPDX-License-Identifier: Apache-2.0
#include <tbb/global_control.h>

#include "leafhull/device.h"

namespace leafhull {

struct ThreadLimit::Control {
  tbb::global_control control;
};

ThreadLimit::ThreadLimit(int threads) {
  if (threads == 0) return;
  control_ = std::make_unique<Control>(tbb::global_control(
      tbb::global_control::max_allowed_parallelism, static_cast<std::size_t>(threads)));
}

ThreadLimit::~ThreadLimit() = default;

}  // namespace leafhull
