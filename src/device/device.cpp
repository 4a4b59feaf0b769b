// SPDX-License-Identifier: Apache-2.0
#include "leafhull/device.h"

#include <algorithm>
#include <cctype>
#include <charconv>
#include <cstdio>
#include <cstdlib>
#include <optional>
#include <thread>

#include "device/engine.h"
#include "device/evaluator.h"
#include "leafhull/error.h"

namespace leafhull {
namespace {

constexpr const char* kInstallPocl =
    "Install the OpenCL runtime for CPUs, PoCL (Debian: apt-get install pocl-opencl-icd), or the "
    "driver of your GPU. If PoCL is installed, its cache folder may not be writable: set "
    "POCL_CACHE_DIR.";

constexpr std::string_view kVariants[] = {"vector", "work-item"};
constexpr int kMostThreads = 1024;

struct Found {
  DeviceInfo info;
  cl::Device device;
};

std::string lower(std::string text) {
  std::transform(text.begin(), text.end(), text.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return text;
}

/// PoCL reads how many threads it may start from the environment, once, at the first OpenCL call.
void bound_pocl_threads(int threads) {
  if (threads <= 0) return;
  const std::string count = std::to_string(threads);
  for (const char* name : {"POCL_MAX_PTHREAD_COUNT", "POCL_CPU_MAX_CU_COUNT"}) {  // PoCL < 4, >= 4
    const char* bound = std::getenv(name);
    if (!bound || bound != count) setenv(name, count.c_str(), 1);
  }
}

/// Whether a version such as "OpenCL 1.2 ..." is 1.2 or later.
bool at_least_1_2(const std::string& version) {
  int major = 0, minor = 0;
  return std::sscanf(version.c_str(), "OpenCL %d.%d", &major, &minor) == 2 &&
         (major > 1 || (major == 1 && minor >= 2));
}

std::string reason_unusable(const cl::Device& device, const DeviceInfo& info) {
  if (!device.getInfo<CL_DEVICE_AVAILABLE>()) return "not available";
  if (!device.getInfo<CL_DEVICE_COMPILER_AVAILABLE>()) return "has no compiler";
  if (!at_least_1_2(info.version)) return "older than OpenCL 1.2";
  if (!device.getInfo<CL_DEVICE_ENDIAN_LITTLE>()) return "big-endian";
  return {};
}

Found describe(const cl::Platform& platform, const cl::Device& device) {
  DeviceInfo info;
  info.name = trimmed(device.getInfo<CL_DEVICE_NAME>());
  info.platform = trimmed(platform.getInfo<CL_PLATFORM_NAME>());
  info.version = trimmed(device.getInfo<CL_DEVICE_VERSION>());
  info.driver = trimmed(device.getInfo<CL_DRIVER_VERSION>());
  const cl_device_type type = device.getInfo<CL_DEVICE_TYPE>();
  info.type = type & CL_DEVICE_TYPE_CPU ? "CPU" : type & CL_DEVICE_TYPE_GPU ? "GPU" : "other";
  info.variant = info.type == "CPU" ? "vector" : "work-item";
  info.compute_units = static_cast<int>(device.getInfo<CL_DEVICE_MAX_COMPUTE_UNITS>());
  info.memory_bytes = device.getInfo<CL_DEVICE_GLOBAL_MEM_SIZE>();
  info.reason = reason_unusable(device, info);
  info.usable = info.reason.empty();
  return {info, device};
}

/// A device that its driver fails to describe.
Found unanswering(const cl::Device& device, const cl::Error& error) {
  DeviceInfo info;
  info.name = "unknown";
  info.reason = std::string("does not answer: ") + error.what() + " failed";
  return {info, device};
}

std::vector<Found> find_devices() {
  std::vector<Found> found;
  std::vector<cl::Platform> platforms;
  try {
    cl::Platform::get(&platforms);
  } catch (const cl::Error&) {
    return found;  // the loader reports that there is no platform
  }
  for (const cl::Platform& platform : platforms) {
    std::vector<cl::Device> devices;
    try {
      platform.getDevices(CL_DEVICE_TYPE_ALL, &devices);
    } catch (const cl::Error&) {
      continue;  // a platform without devices
    }
    for (const cl::Device& device : devices) {
      try {
        found.push_back(describe(platform, device));
      } catch (const cl::Error& error) {
        found.push_back(unanswering(device, error));
      }
    }
  }
  return found;
}

/// The device that `choice` names, by index or part of a name; none where nothing matches.
std::optional<std::size_t> named(const std::vector<Found>& devices, const std::string& choice) {
  std::size_t index = 0;
  const char* end = choice.data() + choice.size();
  if (const auto [p, error] = std::from_chars(choice.data(), end, index);
      error == std::errc{} && p == end) {
    return index < devices.size() ? std::optional(index) : std::nullopt;
  }
  for (std::size_t i = 0; i < devices.size(); ++i) {
    const DeviceInfo& info = devices[i].info;
    if (lower(info.name + " " + info.platform).find(lower(choice)) != std::string::npos) return i;
  }
  return std::nullopt;
}

/// A usable GPU, else a usable CPU, else anything usable.
std::optional<std::size_t> by_default(const std::vector<Found>& devices) {
  for (const char* type : {"GPU", "CPU", "other"}) {
    for (std::size_t i = 0; i < devices.size(); ++i) {
      if (devices[i].info.usable && devices[i].info.type == type) return i;
    }
  }
  return std::nullopt;
}

/// Marks the chosen device, says why for each, and applies a variant that was asked for.
std::optional<std::size_t> choose(std::vector<Found>& devices, const DeviceOptions& options) {
  const auto chosen = options.choice.empty() ? by_default(devices) : named(devices, options.choice);
  for (std::size_t i = 0; i < devices.size(); ++i) {
    DeviceInfo& info = devices[i].info;
    if (!options.variant.empty()) info.variant = options.variant;
    if (i == chosen) {
      info.chosen = info.usable;
      if (!info.usable) continue;
      info.reason = !options.choice.empty() ? "matches --device " + options.choice
                    : info.type == "GPU"    ? "the first usable GPU"
                    : info.type == "CPU"    ? "no usable GPU; the first CPU"
                                            : "neither a GPU nor a CPU is usable";
    } else if (info.usable) {
      info.reason = "usable, not chosen";
    }
  }
  return chosen;
}

std::string listing(const std::vector<Found>& devices) {
  std::string text;
  for (std::size_t i = 0; i < devices.size(); ++i) {
    text += (i ? ", " : "") + std::to_string(i) + ": " + devices[i].info.name;
  }
  return text;
}

}  // namespace

std::span<const std::string_view> kernel_variants() { return kVariants; }

std::span<const DeviceOptionRow> device_table() {
  using Row = DeviceOptionRow;
  static const Row rows[] = {
      Row("Device", "device", &DeviceOptions::choice,
          "the OpenCL device; leafhull devices lists them",
          {.range = "part of a name, or an index", .default_value = "a GPU, else a CPU"}),
      Row("Device", "variant", &DeviceOptions::variant,
          "the density kernel; the result is the same within rounding",
          {.default_value = "by device type", .choices = kVariants}),
      Row("Device", "threads", &DeviceOptions::threads, {1, kMostThreads},
          "bounds the threads of OpenCL on the CPU and of TBB", {.default_value = "all cores"}),
  };
  return rows;
}

std::vector<DeviceInfo> list_devices(const DeviceOptions& options) {
  bound_pocl_threads(options.threads);
  std::vector<Found> found = find_devices();
  choose(found, options);
  std::vector<DeviceInfo> infos;
  for (const Found& one : found) infos.push_back(one.info);
  return infos;
}

Device::Device(const DeviceOptions& options) : engine_(std::make_unique<Engine>()) {
  if (!options.variant.empty() &&
      std::ranges::find(kernel_variants(), options.variant) == kernel_variants().end()) {
    throw Error(ErrorCode::usage, "there is no kernel variant '" + options.variant + "'",
                "Use vector or work-item.");
  }
  bound_pocl_threads(options.threads);
  std::vector<Found> devices = find_devices();
  if (devices.empty()) throw Error(ErrorCode::device, "no OpenCL device was found", kInstallPocl);
  const auto chosen = choose(devices, options);
  if (!chosen) {
    if (options.choice.empty()) {
      throw Error(ErrorCode::device,
                  "none of the OpenCL devices is usable (" + listing(devices) + ")", kInstallPocl);
    }
    throw Error(ErrorCode::device, "no OpenCL device matches '" + options.choice + "'",
                "There are: " + listing(devices) + ".");
  }
  const Found& device = devices[*chosen];
  if (!device.info.usable) {
    throw Error(ErrorCode::device,
                "the OpenCL device '" + device.info.name + "' is unusable: " + device.info.reason,
                "Leave --device out to use another.");
  }
  engine_->info = device.info;
  engine_->threads = options.threads;
  try {
    engine_->device = device.device;
    engine_->float_lanes = device.device.getInfo<CL_DEVICE_NATIVE_VECTOR_WIDTH_FLOAT>();
    engine_->context = cl::Context(device.device);
    engine_->queue = cl::CommandQueue(engine_->context, device.device);
  } catch (const cl::Error& error) {
    throw Error(ErrorCode::device,
                "the OpenCL device '" + device.info.name + "' could not be opened: " +
                    error.what() + " failed with " + std::to_string(error.err()),
                "Choose another with --device; `leafhull devices` lists them.");
  }
}

Device::~Device() = default;
Device::Device(Device&&) noexcept = default;
Device& Device::operator=(Device&&) noexcept = default;

const DeviceInfo& Device::info() const { return engine_->info; }

int Device::threads() const { return engine_->threads; }

bool Device::may_overlap() const {
  const int threads = engine_->threads;
  return threads == 0 || !engine_->shares_memory() ||
         static_cast<unsigned>(threads) >= std::thread::hardware_concurrency();
}

std::future<Device> open_device(const DeviceOptions& options, int falloff) {
  // This must happen here: no thread may write the environment while another reads it.
  bound_pocl_threads(options.threads);
  const auto when = options.threads == 1 ? std::launch::deferred : std::launch::async;
  return std::async(when, [options, falloff] {
    Device device(options);
    prepare(device, falloff);
    return device;
  });
}

}  // namespace leafhull
