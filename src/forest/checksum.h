// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <ostream>
#include <streambuf>
#include <string>
#include <string_view>

#include "forest/record.h"

namespace leafhull {

/// SHA-256 of bytes that come piece by piece.
class Checksum {
 public:
  Checksum();
  ~Checksum();
  Checksum(Checksum&&) noexcept;
  Checksum& operator=(Checksum&&) = delete;

  void add(std::string_view bytes);
  /// Of everything so far; nothing can be added after.
  FileRecord record();

 private:
  struct Context;
  std::unique_ptr<Context> context_;
  std::uint64_t bytes_ = 0;
};

/// A stream that passes what it is given on to another and takes its checksum. It does not seek.
class ChecksumStream : public std::ostream {
 public:
  explicit ChecksumStream(std::ostream& next) : std::ostream(nullptr), buffer_(next) {
    rdbuf(&buffer_);
    exceptions(std::ios_base::badbit | std::ios_base::failbit);
  }
  FileRecord record() { return buffer_.checksum.record(); }

 private:
  struct Buffer : std::streambuf {
    explicit Buffer(std::ostream& stream) : next(stream) {}
    int_type overflow(int_type character) override;
    std::streamsize xsputn(const char* data, std::streamsize size) override;

    std::ostream& next;
    Checksum checksum;
  };
  Buffer buffer_;
};

}  // namespace leafhull
