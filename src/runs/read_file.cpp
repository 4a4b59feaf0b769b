// SPDX-License-Identifier: Apache-2.0
#include "runs/read_file.h"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <system_error>
#include <vector>

namespace leafhull {

int read_rest(int descriptor, const std::function<void(std::string_view)>& take) {
  std::vector<char> buffer(1 << 20);
  for (;;) {
    const ssize_t count = ::read(descriptor, buffer.data(), buffer.size());
    if (count == 0) return 0;
    if (count > 0) {
      take({buffer.data(), static_cast<std::size_t>(count)});
    } else if (errno != EINTR) {
      return errno;
    }
  }
}

void read_file(const std::filesystem::path& file, ErrorCode code,
               const std::function<void(std::string_view)>& take) {
  struct Descriptor {
    const int number;
    ~Descriptor() {
      if (number >= 0) ::close(number);
    }
  } const opened{::open(file.c_str(), O_RDONLY | O_CLOEXEC)};
  const int reason = opened.number < 0 ? errno : read_rest(opened.number, take);
  if (reason == 0) return;
  throw Error(code, "cannot read " + file.string() + ": " + std::generic_category().message(reason),
              "Check the disk and the file's permissions.");
}

std::string content_of(const std::filesystem::path& file) {
  std::string content;
  read_file(file, ErrorCode::input, [&](std::string_view piece) { content += piece; });
  return content;
}

}  // namespace leafhull
