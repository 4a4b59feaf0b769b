// SPDX-License-Identifier: Apache-2.0
#include "cli/context.h"

#include <sys/resource.h>

#include <algorithm>
#include <iterator>

#include "cli/values.h"

namespace leafhull::cli {
namespace {

bool is_stage(const StageTime& time) { return time.stage != "total"; }

}  // namespace

Context::Context(const Arguments& arguments, bool speaks)
    : console(arguments.quiet || !speaks, arguments.verbose && speaks), arguments_(arguments) {}

void Context::warn(const std::vector<std::string>& warnings) {
  for (const std::string& warning : warnings) console.warn(warning);
  std::ranges::copy_if(warnings, std::back_inserter(warnings_), [&](const std::string& warning) {
    return std::ranges::find(warnings_, warning) == warnings_.end();
  });
}

void Context::open_device(const DeviceOptions& options, int falloff) {
  opening_ = leafhull::open_device(options, falloff);
}

Device& Context::device() {
  if (!device_) device_.emplace(timed("device", [&] { return opening_.get(); }));
  return *device_;
}

TreeModel Context::read(const std::filesystem::path& file, std::string_view stage) {
  TreeModel tree = timed(stage, [&] { return read_tree(file, arguments_.options.read_options()); });
  warn(tree.warnings);
  return tree;
}

LeafSet Context::find_leaves(const TreeModel& tree, const LeafOptions& options) {
  LeafSet leaves = timed("leaves", [&] { return leafhull::find_leaves(tree, options); });
  warn(leaves.warnings);
  return leaves;
}

LeafSet Context::read_leaves(const LeafOptions& options) {
  return find_leaves(read(arguments_.operand), options);
}

Progress Context::progress() {
  return [this](const Advance& now) { console.progress(now); };
}

void Context::add_times(const std::vector<StageTime>& times) {
  std::ranges::copy_if(times, std::back_inserter(times_), is_stage);
}

std::vector<StageTime> Context::times() const {
  std::vector<StageTime> all = times_;
  all.push_back({"total", elapsed()});
  return all;
}

void Context::say_stages(const std::vector<StageTime>& times, const std::string& indent,
                         std::size_t width) {
  for (const StageTime& time : times) {
    std::string stage = time.stage;
    stage.resize(std::max(stage.size(), width), ' ');
    console.detail(indent + stage + "  " + seconds(time.seconds));
  }
}

std::uint64_t peak_memory_bytes() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return static_cast<std::uint64_t>(usage.ru_maxrss) * 1024;
}

}  // namespace leafhull::cli
