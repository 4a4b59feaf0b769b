// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "leafhull/device.h"
#include "leafhull/leaves.h"
#include "pipeline/stopwatch.h"

namespace leafhull {

/// The tree and the device that stages work with, the stopwatch that reports their progress, and
/// how much they compute.
struct Run {
  const LeafSet& leaves;
  Device& device;
  Stopwatch& watch;
  Detail detail = Detail::report;
};

}  // namespace leafhull
