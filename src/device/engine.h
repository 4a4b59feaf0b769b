// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>
#include <mutex>
#include <span>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "device/opencl.h"
#include "leafhull/device.h"
#include "leafhull/error.h"

namespace leafhull {

/// A driver's answer without the padding of some drivers.
std::string trimmed(std::string text);

/// Sets all arguments of a kernel, in order.
template <class... Arguments>
void set_arguments(cl::Kernel& kernel, const Arguments&... arguments) {
  cl_uint i = 0;
  (kernel.setArg(i++, arguments), ...);
}

/// An opened device: its context, its queue and the programs built so far.
struct Device::Engine {
  DeviceInfo info;
  int threads = 0;           ///< 0: all cores
  unsigned float_lanes = 0;  ///< floats in the device's native vectors
  cl::Device device;
  cl::Context context;
  cl::CommandQueue queue;
  std::map<std::pair<std::string, std::string>, cl::Program> programs;  ///< by name and options
  std::mutex busy;                                                      ///< held by run()

  /// True for the variant with explicit vectors.
  bool vector() const { return info.variant == "vector"; }

  /// The number of points in a chunk (points.cl): the lanes of its widest vectors.
  std::size_t chunk_points() const { return vector() && float_lanes >= 16 ? 16 : 8; }

  /// Whether the device works in the host's memory, so that buffers need no copies.
  bool shares_memory() const { return info.type == "CPU"; }

  /// @throws Error device: the compiler's log.
  cl::Program build(const cl::Program::Sources& sources, const std::string& options) const;

  /// A kernel of the program `program`, which is built at the first call with these options.
  /// @throws Error device, as build.
  cl::Kernel kernel(const char* name, const std::string& program,
                    const cl::Program::Sources& sources, const std::string& options);

  /// Build options of every density kernel: the constants that it shares with the host.
  static std::string density_options(int falloff);

  /// The density kernel `name` for a falloff.
  /// @throws Error device, as build.
  cl::Kernel kernel(const char* name, int falloff);

  /// Runs `work` for one thread at a time and turns OpenCL's exceptions into Error.
  template <class Work>
  auto run(const char* what, Work&& work) {
    const std::lock_guard alone(busy);
    try {
      return work();
    } catch (const cl::Error& error) {
      clFinish(queue());  // nothing may still use the host's buffers
      throw Error(ErrorCode::device,
                  std::string(what) + " failed on '" + info.name + "': " + error.what() +
                      " returned " + std::to_string(error.err()),
                  "Try a lower resolution or another device (`leafhull devices`).");
    }
  }

  /// A buffer over host values, in place if the device shares the host's memory. OpenCL has no
  /// empty buffers, so an empty span gives one byte.
  template <class T>
  cl::Buffer buffer(std::span<T> values, cl_mem_flags access) const {
    if (values.empty()) return cl::Buffer(context, access, 1);
    if (access == CL_MEM_WRITE_ONLY && !shares_memory()) {
      return cl::Buffer(context, access, values.size_bytes());
    }
    const cl_mem_flags place = shares_memory() ? CL_MEM_USE_HOST_PTR : CL_MEM_COPY_HOST_PTR;
    return cl::Buffer(context, access | place, values.size_bytes(),
                      const_cast<std::remove_const_t<T>*>(values.data()));
  }
  template <class T>
  cl::Buffer input(const std::vector<T>& values) const {
    return buffer(std::span<const T>(values), CL_MEM_READ_ONLY);
  }

  /// Waits for the device and makes its results visible in `values`.
  template <class T>
  void fetch(const cl::Buffer& buffer, std::span<T> values) {
    if (!values.empty() && shares_memory()) {
      void* mapped = queue.enqueueMapBuffer(buffer, CL_TRUE, CL_MAP_READ, 0, values.size_bytes());
      queue.enqueueUnmapMemObject(buffer, mapped);
    } else if (!values.empty()) {
      queue.enqueueReadBuffer(buffer, CL_TRUE, 0, values.size_bytes(), values.data());
    }
    queue.finish();
  }
};

}  // namespace leafhull
