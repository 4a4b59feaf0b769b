// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <filesystem>
#include <map>

#include "runs/sealed_json.h"
#include "runs/sealed_lines.h"

namespace leafhull {

/// The progress of a sweep: sealed lines, the first saying which sweep it is, every other one
/// holding a combination. A line that is damaged does not count.
class Journal {
 public:
  /// Opens or creates `file`, keeps other processes out of it, and reads it.
  /// @throws Error output: it cannot be written; usage: it is no journal, or another process has
  /// it.
  explicit Journal(const std::filesystem::path& file);

  /// The header; null in a new journal.
  const Json& header() const { return header_; }
  /// Whether the header is whole and of this version, or the journal is new.
  bool is_readable() const { return is_readable_; }
  /// The combinations that are done, by their index `row`.
  const std::map<std::size_t, Json>& rows() const { return rows_; }

  /// Forgets everything and begins with `header`. @throws Error output.
  void begin(const Json& header);
  /// Adds a combination. @throws Error output; the journal is then as before.
  void append(Json row);

 private:
  SealedLines lines_;
  Json header_;
  bool is_readable_ = true;
  std::map<std::size_t, Json> rows_;
};

}  // namespace leafhull
