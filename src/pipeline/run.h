// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "leafhull/device.h"
#include "leafhull/leaves.h"
#include "pipeline/stopwatch.h"

namespace leafhull {

/// The tree and the device that stages work with, and the stopwatch that reports their progress.
struct Run {
  const LeafSet& leaves;
  Device& device;
  Stopwatch& watch;
};

}  // namespace leafhull
