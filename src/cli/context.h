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

/// What verbs repeat: they read a tree, open a device meanwhile, warn, and tell how long it took.
class Context {
 public:
  /// @param speaks false: nothing is said, whatever the arguments.
  /// @throws Error usage: --quiet and --verbose.
  explicit Context(const Arguments& arguments, bool speaks = true);

  Console console;

  /// Says each warning once and keeps it.
  void warn(const std::vector<std::string>& warnings);
  const std::vector<std::string>& warnings() const { return warnings_; }

  /// Opens the device and builds its kernels while the tree is read.
  void open_device(const DeviceOptions& options, int falloff);
  void open_device(int falloff) { open_device(arguments_.device, falloff); }
  /// Waits for it.
  Device& device();

  TreeModel read(const std::filesystem::path& file, std::string_view stage = "read");
  LeafSet find_leaves(const TreeModel& tree, const LeafOptions& options);
  /// The operand's leaves; the tree is given back before the memory is needed.
  LeafSet read_leaves(const LeafOptions& options);

  /// What the library's functions tell of themselves on the way.
  Progress progress();
  double elapsed() const { return since(start_); }
  /// Adds what the library took, but for its total.
  void add_times(const std::vector<StageTime>& times);
  /// Of all stages so far, in order, the total last.
  std::vector<StageTime> times() const;
  /// Details: a line for each stage but the total.
  void say_stages(const std::vector<StageTime>& times, const std::string& indent,
                  std::size_t width);

  /// What `work` returns; it counts as a stage.
  template <class Work>
  auto timed(std::string_view stage, Work&& work) {
    console.progress(stage, 0);
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

/// The most memory that this process has had.
std::uint64_t peak_memory_bytes();

}  // namespace leafhull::cli
