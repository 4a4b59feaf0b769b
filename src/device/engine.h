// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>
#include <string>
#include <string_view>
#include <utility>

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
  std::map<std::pair<std::string_view, std::string>, cl::Program> programs;

  /// True for the variant with explicit vectors.
  bool vector() const { return info.variant == "vector"; }

  /// Whether the device works in the host's memory, so that buffers need no copies.
  bool shares_memory() const { return info.type == "CPU"; }

  /// The kernel `name` of an OpenCL source, built once per set of build options.
  /// @throws Error device: the compiler's log.
  cl::Kernel kernel(std::string_view source, const std::string& options, const char* name);
};

}  // namespace leafhull
