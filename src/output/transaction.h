// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <functional>
#include <ostream>
#include <string_view>
#include <vector>

#include "output/temporary_file.h"

namespace leafhull {

/// Several files that appear together or not at all: each is written under a temporary name beside
/// its destination, and `commit` renames them. Without a commit nothing remains.
class Transaction {
 public:
  /// Lets `writer` fill the file that will become `name`. A symbolic link stays, its target is
  /// replaced;
  /// permissions of an existing file are kept where possible.
  /// @throws Error output, and whatever `writer` throws.
  void write(const std::filesystem::path& name, const std::function<void(std::ostream&)>& writer);

  /// Adds a file that another program has filled and that lies beside the future `name`.
  /// @throws Error output.
  void add(const std::filesystem::path& name, TemporaryFile file);

  /// Puts every file in place. If one fails, those before it are put back, unless the file system
  /// cannot exchange two names.
  /// @throws Error output.
  void commit();

 private:
  enum class Placement { pending, created, exchanged, overwritten };

  struct Entry {
    std::filesystem::path destination;
    TemporaryFile file;
    Placement placement = Placement::pending;

    void put_in_place();
    void take_back() noexcept;
  };

  std::vector<Entry> entries_;
};

/// Writes the whole file or leaves it as it was.
/// @throws Error output.
void write_file(const std::filesystem::path& name, std::string_view bytes);

}  // namespace leafhull
