// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <sys/types.h>

#include <filesystem>
#include <string>
#include <vector>

#include "runs/sealed_json.h"

namespace leafhull {

/// A journal: a text file to which one process at a time adds lines of JSON, each sealed. A line is
/// on the disk before the next is begun; a last one that a crash has cut short does not count, and
/// is cut off by the next append.
class SealedLines {
 public:
  /// Opens or creates `file`, keeps other writers out of it, and reads it.
  /// @param rival who else may have the file, for the error.
  /// @throws Error output: it cannot be written; usage: another process has it.
  SealedLines(std::filesystem::path file, const std::string& rival);
  ~SealedLines();
  SealedLines(const SealedLines&) = delete;
  SealedLines& operator=(const SealedLines&) = delete;

  /// The whole lines that it held when it was opened, as they stood there.
  const std::vector<std::string>& lines() const { return lines_; }
  /// Whether the file held nothing, not even part of a line.
  bool empty() const { return empty_; }

  /// @throws Error output; the file is then as before.
  void append(Json object);
  void clear();

 private:
  void truncate(off_t size);

  std::filesystem::path file_;
  int descriptor_ = -1;
  off_t size_ = 0;  ///< bytes of the whole lines
  bool empty_ = true;
  std::vector<std::string> lines_;
};

/// The whole lines of a file that another process may be adding to.
/// @throws Error input: it cannot be read.
std::vector<std::string> whole_lines(const std::filesystem::path& file);

}  // namespace leafhull
