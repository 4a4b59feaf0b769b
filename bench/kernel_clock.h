// SPDX-License-Identifier: Apache-2.0
// Seconds that OpenCL kernels take on the device. This file's clEnqueueNDRangeKernel overrides the
// loader's, so every launch of the process is timed, whoever makes it.
#pragma once

#include <map>
#include <string>

#include "leafhull/device.h"

namespace leafhull::bench {

/// Gives the device a queue that keeps times. Call it before the device's first work.
void start_kernel_clock(Device& device);

/// Seconds of all launches since the last call, by the kernel's name.
std::map<std::string, double> take_kernel_seconds();

}  // namespace leafhull::bench
