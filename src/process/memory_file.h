// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>

namespace leafhull {

/// A file in memory, without a name: unlike a pipe it is never full.
class MemoryFile {
 public:
  /// @throws std::system_error.
  MemoryFile();
  ~MemoryFile();
  MemoryFile(const MemoryFile&) = delete;
  MemoryFile& operator=(const MemoryFile&) = delete;

  int descriptor() const { return descriptor_; }

  /// Appends, then goes back to the start. @throws std::system_error.
  void write(std::string_view text) const;
  /// All of it. @throws std::system_error.
  std::string read() const;

 private:
  int descriptor_;
};

}  // namespace leafhull
