// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <cstdint>
#include <filesystem>
#include <future>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "cli/arguments.h"
#include "cli/console.h"
#include "leafhull/shape.h"
#include "leafhull/tree.h"

namespace leafhull::cli {

/// What verbs share: they read a tree while a device opens, warn, and say how long it took.
class Context {
 public:
  /// @param speaks false: nothing is said, whatever the arguments.
  /// @throws Error usage: --quiet and --verbose together.
  explicit Context(const Arguments& arguments, bool speaks = true);

  Console console;

  /// Says each warning once and keeps it.
  void warn(const std::vector<std::string>& warnings);
  const std::vector<std::string>& warnings() const { return warnings_; }

  /// Opens the device and builds its kernels while the tree is read.
  void open_device(const DeviceOptions& options, int falloff);
  void open_device(int falloff) { open_device(arguments_.device, falloff); }
  /// Waits for the device.
  Device& device();

  TreeModel read(const std::filesystem::path& file, std::string_view stage = "read");
  LeafSet find_leaves(const TreeModel& tree, const LeafOptions& options);
  /// The operand's leaves; the tree is given back before the memory is needed.
  LeafSet read_leaves(const LeafOptions& options);

  /// Shows the progress that the library's functions report.
  Progress progress();
  double elapsed() const { return since(start_); }
  /// Adds the library's stages, without its total.
  void add_times(const std::vector<StageTime>& times);
  /// All stages so far, in order, the total last.
  std::vector<StageTime> times() const;
  /// Says a detail line for each stage but the total.
  void say_stages(const std::vector<StageTime>& times, const std::string& indent,
                  std::size_t width);

  /// Runs `work` as a stage and returns its result.
  template <class Work>
  auto timed(std::string_view stage, Work&& work) {
    console.progress({.stage = stage});
    const auto begin = std::chrono::steady_clock::now();
    auto result = work();
    times_.push_back({std::string(stage), since(begin)});
    return result;
  }

 private:
  const Arguments& arguments_;
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
  std::vector<StageTime> times_;
  std::vector<std::string> warnings_;
  std::future<Device> opening_;
  std::optional<Device> device_;
};

/// The peak memory of this process.
std::uint64_t peak_memory_bytes();

}  // namespace leafhull::cli
