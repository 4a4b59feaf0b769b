// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <filesystem>
#include <fstream>
#include <istream>
#include <string>

namespace leafhull {

/// @throws Error input: the file cannot be read.
std::ifstream open_text(const std::filesystem::path& file);

/// The lines of a text file that say something: blank ones and those that begin with # are passed
/// over, as are a byte order mark and carriage returns.
class Lines {
 public:
  /// @param file the name that messages use.
  Lines(std::istream& stream, const std::filesystem::path& file) : file_(file), stream_(stream) {}

  /// @throws Error input: the file cannot be read, or is UTF-16 text.
  bool next();
  std::string& text() { return text_; }
  std::size_t number() const { return number_; }  ///< from one

 private:
  std::filesystem::path file_;
  std::istream& stream_;
  std::string text_;
  std::size_t number_ = 0;
};

}  // namespace leafhull
