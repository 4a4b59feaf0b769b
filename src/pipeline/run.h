// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "leafhull/device.h"
#include "leafhull/leaves.h"
#include "pipeline/stopwatch.h"

namespace leafhull {

/// The tree that stages work on, the device that they work with, and who is told of it.
struct Run {
  const LeafSet& leaves;
  Device& device;
  Stopwatch& watch;
};

}  // namespace leafhull
