// SPDX-License-Identifier: Apache-2.0
#include "runs/checksum.h"

#include <openssl/evp.h>

#include <array>

#include "leafhull/error.h"
#include "runs/read_file.h"

namespace leafhull {
namespace {

void check(int succeeded) {
  if (succeeded == 1) return;
  throw Error(ErrorCode::internal, "OpenSSL cannot take a SHA-256 checksum",
              "Please report this with the version of OpenSSL and its configuration.");
}

}  // namespace

Checksum::Checksum() : digest_(EVP_MD_CTX_new(), EVP_MD_CTX_free) {
  check(digest_ && EVP_DigestInit_ex(digest_.get(), EVP_sha256(), nullptr));
}

void Checksum::add(std::string_view bytes) {
  check(EVP_DigestUpdate(digest_.get(), bytes.data(), bytes.size()));
  bytes_ += bytes.size();
}

FileRecord Checksum::record() {
  std::array<unsigned char, EVP_MAX_MD_SIZE> digest;
  unsigned size = 0;
  check(EVP_DigestFinal_ex(digest_.get(), digest.data(), &size));
  constexpr std::string_view kDigits = "0123456789abcdef";
  FileRecord record{.bytes = bytes_, .sha256 = {}};
  for (unsigned i = 0; i < size; ++i) {
    record.sha256 += kDigits[digest[i] >> 4];
    record.sha256 += kDigits[digest[i] & 15];
  }
  return record;
}

FileRecord record_of(std::string_view bytes) {
  Checksum checksum;
  checksum.add(bytes);
  return checksum.record();
}

FileRecord record_of_file(const std::filesystem::path& file) {
  Checksum checksum;
  read_file(file, ErrorCode::output, [&](std::string_view piece) { checksum.add(piece); });
  return checksum.record();
}

}  // namespace leafhull
