// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>
#include <string>
#include <string_view>

#include "device/opencl.h"
#include "leafhull/device.h"

namespace leafhull {

/// An opened device: its context, its queue and the programs built so far.
struct Device::Engine {
  DeviceInfo info;
  int threads = 0;  ///< 0: all cores
  cl::Device device;
  cl::Context context;
  cl::CommandQueue queue;
  std::map<int, cl::Program> programs;  ///< by falloff

  /// True for the variant with explicit vectors.
  bool vector() const { return info.variant == "vector"; }

  /// Whether the device works in the host's memory, so that buffers need no copies.
  bool shares_memory() const { return info.type == "CPU"; }

  /// The kernel `name` for a falloff, built at the first call.
  /// @throws Error device: the compiler's log.
  cl::Kernel kernel(const char* name, int falloff);
};

}  // namespace leafhull
