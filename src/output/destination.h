// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <utility>
#include <vector>

namespace leafhull {

/// The absolute path, free of symbolic links, of the regular file that writing to `name` would
/// create or replace; it need not exist yet.
/// @throws Error output: its folder does not exist or is not writable.
std::filesystem::path resolve_destination(const std::filesystem::path& name);

/// The files that a run is to write: none is an input, and none is written twice.
class Destinations {
 public:
  explicit Destinations(std::vector<std::filesystem::path> inputs) : inputs_(std::move(inputs)) {}

  /// @throws Error usage: `file` is an input or was added before; output: as above.
  void add(const std::filesystem::path& file);

 private:
  std::vector<std::filesystem::path> inputs_;
  std::map<std::filesystem::path, std::filesystem::path> names_;  ///< by destination
};

/// @throws Error usage, always: the file has no extension, or `extension` is unknown.
[[noreturn]] void refuse_extension(const std::filesystem::path& file, const std::string& extension,
                                   const std::string& remedy);

}  // namespace leafhull
