// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
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
  /// The record of all bytes so far; nothing can be added after.
  FileRecord record();

 private:
  std::unique_ptr<evp_md_ctx_st, void (*)(evp_md_ctx_st*)> digest_;
  std::uint64_t bytes_ = 0;
};

/// The record of a file with these bytes.
FileRecord record_of(std::string_view bytes);
/// The record of a file. @throws Error output: the file cannot be read.
FileRecord record_of_file(const std::filesystem::path& file);

}  // namespace leafhull
