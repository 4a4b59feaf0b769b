// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <future>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "leafhull/api.h"
#include "leafhull/option_row.h"

namespace leafhull {

/// An OpenCL device as `leafhull devices` lists it.
struct DeviceInfo {
  std::string name, platform, version, driver;
  std::string type;     ///< "CPU", "GPU" or "other"
  std::string variant;  ///< the density kernel used there: "vector" or "work-item"
  int compute_units = 0;
  std::size_t memory_bytes = 0;
  bool usable = false;
  bool chosen = false;
  std::string reason;  ///< why it is usable or not, chosen or not
};

/// "DEVICE (PLATFORM, VARIANT)".
inline std::string text_of(const DeviceInfo& device) {
  return device.name + " (" + device.platform + ", " + device.variant + ")";
}

struct DeviceOptions {
  std::string choice;   ///< index or part of a name; empty: a GPU if there is one, else a CPU
  int threads = 0;      ///< bounds OpenCL (PoCL) and TBB; 0: all cores
  std::string variant;  ///< one of kernel_variants(); empty: by device type
};

/// The names of the density kernels: "vector" and "work-item".
LEAFHULL_API std::span<const std::string_view> kernel_variants();

using DeviceOptionRow = RowOver<DeviceOptions, std::string, int>;
LEAFHULL_API std::span<const DeviceOptionRow> device_table();

/// Every OpenCL device, in the order of their indices, and which one `options` would choose.
/// Empty where no platform is installed.
LEAFHULL_API std::vector<DeviceInfo> list_devices(const DeviceOptions& options);

/// An opened OpenCL device with leafhull's programs. Threads that share one take turns, each
/// waiting for its own work, so that within a thread the device's work and TBB's never overlap.
/// `threads` reaches PoCL through the environment and counts only before the process's first OpenCL
/// call.
class Device {
 public:
  /// @throws Error device: none, no such one, or one that cannot be opened; usage: no such variant.
  LEAFHULL_API explicit Device(const DeviceOptions& options);
  LEAFHULL_API ~Device();
  LEAFHULL_API Device(Device&&) noexcept;
  LEAFHULL_API Device& operator=(Device&&) noexcept;

  LEAFHULL_API const DeviceInfo& info() const;
  /// The bound on host threads, 0: all cores.
  LEAFHULL_API int threads() const;
  /// Whether its work and TBB's together keep to that bound.
  LEAFHULL_API bool may_overlap() const;

  /// The OpenCL engine behind it, which src/device defines.
  struct Engine;
  Engine& engine() { return *engine_; }

 private:
  std::unique_ptr<Engine> engine_;
};

/// Bounds the number of host threads while it lives, also while trees are read and leaves are
/// found. Where there are several bounds, the smallest applies; functions that take a Device also
/// keep to the device's own bound.
class ThreadLimit {
 public:
  /// @param threads the most threads, or 0 for no bound.
  LEAFHULL_API explicit ThreadLimit(int threads);
  LEAFHULL_API ~ThreadLimit();
  ThreadLimit(const ThreadLimit&) = delete;
  ThreadLimit& operator=(const ThreadLimit&) = delete;

 private:
  struct Control;
  std::unique_ptr<Control> control_;
};

/// Opens a device and builds its kernels for a falloff on a thread of its own, so that the tree can
/// be read meanwhile; with `threads` 1 both wait for get(). The build takes PoCL most of a second
/// the first time, and less than a tenth from its cache.
/// get() throws what Device's constructor and extract throw of a device; the future waits for its
/// thread when it is destroyed.
LEAFHULL_API std::future<Device> open_device(const DeviceOptions& options, int falloff);

}  // namespace leafhull
