// SPDX-License-Identifier: Apache-2.0
#include "input/file_bytes.h"

#include <cerrno>
#include <charconv>
#include <cstdio>
#include <memory>
#include <new>
#include <system_error>

namespace leafhull {
namespace {

namespace fs = std::filesystem;

[[noreturn]] void fail(std::error_code error) { throw FileError(error.message()); }

void check_kind(const fs::path& path, Pipes pipes) {
  std::error_code error;
  const fs::file_status status = fs::status(path, error);
  if (error) fail(error);
  if (fs::is_directory(status)) fail(std::make_error_code(std::errc::is_a_directory));
  const bool is_read = fs::is_regular_file(status) || (fs::is_fifo(status) && pipes == Pipes::read);
  if (!is_read) throw FileError("it is not a regular file");
}

Bytes read_to_end(const fs::path& path) {
  const auto check = [](bool good) {
    if (!good) fail({errno, std::generic_category()});
  };
  const std::unique_ptr<std::FILE, int (*)(std::FILE*)> file(std::fopen(path.c_str(), "rb"),
                                                             &std::fclose);
  check(file != nullptr);
  std::error_code unknown_size;
  const std::uintmax_t expected = fs::file_size(path, unknown_size);

  Bytes bytes(unknown_size ? 0 : expected + 1);  // one more, to notice the end
  std::size_t length = 0;
  for (;;) {
    if (length == bytes.size()) bytes.resize(length + (1 << 16));
    const std::size_t got = std::fread(bytes.data() + length, 1, bytes.size() - length, file.get());
    length += got;
    check(std::ferror(file.get()) == 0);
    if (got == 0) break;
  }
  bytes.resize(length);
  return bytes;
}

constexpr const char* kTooLarge = "it is too large for the memory";

}  // namespace

Bytes read_file(const fs::path& path, Pipes pipes) try {
  check_kind(path, pipes);
  return read_to_end(path);
} catch (const std::bad_alloc&) {
  throw FileError(kTooLarge);
} catch (const std::length_error&) {
  throw FileError(kTooLarge);
}

std::string percent_decoded(std::string_view uri) {
  std::string text;
  for (std::size_t i = 0; i < uri.size(); ++i) {
    unsigned char value = 0;
    const char* digits = uri.data() + i + 1;
    if (uri[i] == '%' && i + 2 < uri.size() &&
        std::from_chars(digits, digits + 2, value, 16).ptr == digits + 2) {
      text += static_cast<char>(value);
      i += 2;
    } else {
      text += uri[i];
    }
  }
  return text;
}

}  // namespace leafhull
