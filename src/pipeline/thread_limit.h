// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <tbb/global_control.h>

#include <optional>

#include "leafhull/device.h"

namespace leafhull {

/// Bounds TBB's threads by the device's as long as it lives.
class ThreadLimit {
 public:
  explicit ThreadLimit(const Device& device) {
    if (device.threads() == 0) return;
    limit_.emplace(tbb::global_control::max_allowed_parallelism,
                   static_cast<std::size_t>(device.threads()));
  }

 private:
  std::optional<tbb::global_control> limit_;
};

}  // namespace leafhull
