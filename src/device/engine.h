// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>
#include <string>

#include "device/opencl.h"
#include "leafhull/device.h"

namespace leafhull {

/// A driver's answer without the padding of some drivers.
std::string trimmed(std::string text);

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

  /// @throws Error device: the compiler's log.
  cl::Program build(const cl::Program::Sources& sources, const std::string& options) const;

  /// The kernel `name` for a falloff, from a program that is built at the first call.
  /// @throws Error device, as build.
  cl::Kernel kernel(const char* name, int falloff);
};

}  // namespace leafhull
