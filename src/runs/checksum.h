// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <ostream>
#include <streambuf>
#include <string>
#include <string_view>

struct evp_md_ctx_st;  // OpenSSL's EVP_MD_CTX

namespace leafhull {

/// A file that belongs to a run.
struct FileRecord {
  std::uint64_t bytes = 0;
  std::string sha256;  ///< hexadecimal; empty: there is no such file
  friend bool operator==(const FileRecord&, const FileRecord&) = default;
};

/// SHA-256 of bytes that come piece by piece.
class Checksum {
 public:
  Checksum();

  void add(std::string_view bytes);
  /// Of everything so far; nothing can be added after.
  FileRecord record();

 private:
  std::unique_ptr<evp_md_ctx_st, void (*)(evp_md_ctx_st*)> digest_;
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

FileRecord record_of(std::string_view bytes);

/// @throws Error output: the file cannot be read.
FileRecord record_of_file(const std::filesystem::path& file);

}  // namespace leafhull
