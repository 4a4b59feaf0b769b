// SPDX-License-Identifier: Apache-2.0
#include "input/file_bytes.h"

#include <cerrno>
#include <charconv>
#include <cstdio>
#include <memory>
#include <system_error>

namespace leafhull {

Bytes read_file(const std::filesystem::path& path) {
  const auto check = [](bool good) {
    if (!good) throw std::system_error(errno, std::generic_category());
  };
  // A folder opens like a file and fails at the first read, with EISDIR.
  const std::unique_ptr<std::FILE, int (*)(std::FILE*)> file(std::fopen(path.c_str(), "rb"),
                                                             &std::fclose);
  check(file != nullptr);
  std::error_code unknown_size;
  const std::uintmax_t expected = std::filesystem::file_size(path, unknown_size);

  Bytes bytes(unknown_size ? 0 : expected);
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
