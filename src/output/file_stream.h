// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <ostream>
#include <streambuf>
#include <vector>

namespace leafhull {

/// A buffered, seekable file descriptor whose every failure is thrown as Error output.
class FileBuffer : public std::streambuf {
 public:
  /// @param name the file's name in errors.
  FileBuffer(int descriptor, std::filesystem::path name);

 protected:
  int_type overflow(int_type character) override;
  std::streamsize xsputn(const char* data, std::streamsize size) override;
  int sync() override;
  pos_type seekoff(off_type offset, std::ios_base::seekdir from, std::ios_base::openmode) override;
  pos_type seekpos(pos_type position, std::ios_base::openmode mode) override;

 private:
  void write_buffered();
  void write_all(const char* data, std::size_t size);

  int descriptor_;
  std::filesystem::path name_;
  std::vector<char> buffer_;
};

/// An output stream over an open file descriptor, which it does not close. Any operation on it may
/// throw Error output; written data is in the file only after `flush()`.
class FileStream : public std::ostream {
 public:
  FileStream(int descriptor, std::filesystem::path name)
      : std::ostream(nullptr), buffer_(descriptor, std::move(name)) {
    rdbuf(&buffer_);
    exceptions(std::ios_base::badbit | std::ios_base::failbit);
  }

 private:
  FileBuffer buffer_;
};

}  // namespace leafhull
