// SPDX-License-Identifier: Apache-2.0
#include "forest/checksum.h"

#include <fcntl.h>
#include <openssl/evp.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <system_error>
#include <vector>

#include "forest/store.h"
#include "leafhull/error.h"

namespace leafhull {
namespace {

namespace fs = std::filesystem;

void check(int succeeded) {
  if (succeeded == 1) return;
  throw Error(ErrorCode::internal, "OpenSSL cannot take a SHA-256 checksum",
              "Please report this with the version of OpenSSL and its configuration.");
}

}  // namespace

struct Checksum::Context {
  struct Free {
    void operator()(EVP_MD_CTX* context) const { EVP_MD_CTX_free(context); }
  };
  std::unique_ptr<EVP_MD_CTX, Free> digest{EVP_MD_CTX_new()};
};

Checksum::Checksum() : context_(std::make_unique<Context>()) {
  check(context_->digest && EVP_DigestInit_ex(context_->digest.get(), EVP_sha256(), nullptr));
}
Checksum::~Checksum() = default;
Checksum::Checksum(Checksum&&) noexcept = default;

void Checksum::add(std::string_view bytes) {
  check(EVP_DigestUpdate(context_->digest.get(), bytes.data(), bytes.size()));
  bytes_ += bytes.size();
}

FileRecord Checksum::record() {
  std::array<unsigned char, EVP_MAX_MD_SIZE> digest;
  unsigned size = 0;
  check(EVP_DigestFinal_ex(context_->digest.get(), digest.data(), &size));
  constexpr std::string_view kDigits = "0123456789abcdef";
  FileRecord record{.bytes = bytes_, .sha256 = {}};
  for (unsigned i = 0; i < size; ++i) {
    record.sha256 += kDigits[digest[i] >> 4];
    record.sha256 += kDigits[digest[i] & 15];
  }
  return record;
}

ChecksumStream::Buffer::int_type ChecksumStream::Buffer::overflow(int_type character) {
  if (traits_type::eq_int_type(character, traits_type::eof())) return 0;
  const char byte = traits_type::to_char_type(character);
  xsputn(&byte, 1);
  return character;
}

std::streamsize ChecksumStream::Buffer::xsputn(const char* data, std::streamsize size) {
  checksum.add({data, static_cast<std::size_t>(size)});
  next.write(data, size);
  return size;
}

FileRecord record_of(std::string_view bytes) {
  Checksum checksum;
  checksum.add(bytes);
  return checksum.record();
}

FileRecord record_of_file(const fs::path& file) {
  const int descriptor = ::open(file.c_str(), O_RDONLY | O_CLOEXEC);
  int reason = descriptor < 0 ? errno : 0;
  Checksum checksum;
  std::vector<char> buffer(1 << 20);
  while (reason == 0) {
    const ssize_t count = ::read(descriptor, buffer.data(), buffer.size());
    if (count == 0) break;
    if (count > 0) checksum.add({buffer.data(), static_cast<std::size_t>(count)});
    if (count < 0 && errno != EINTR) reason = errno;
  }
  if (descriptor >= 0) ::close(descriptor);
  if (reason == 0) return checksum.record();
  throw Error(ErrorCode::output,
              "cannot read " + file.string() + ": " + std::generic_category().message(reason),
              "Check the disk and the file's permissions.");
}

}  // namespace leafhull
