// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <filesystem>
#include <fstream>
#include <string>

namespace leafhull {

/// The lines of a text file that say something: blank ones and those that begin with # are passed
/// over, as are a byte order mark and carriage returns.
class Lines {
 public:
  /// @throws Error input: the file cannot be read.
  explicit Lines(const std::filesystem::path& file);

  /// @throws Error input, as the constructor, or where the text is UTF-16.
  bool next();
  std::string& text() { return text_; }
  std::size_t number() const { return number_; }  ///< from one

 private:
  std::filesystem::path file_;
  std::ifstream stream_;
  std::string text_;
  std::size_t number_ = 0;
};

}  // namespace leafhull
