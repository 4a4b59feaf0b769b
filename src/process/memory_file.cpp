// SPDX-License-Identifier: Apache-2.0
#include "process/memory_file.h"

#include <sys/mman.h>
#include <unistd.h>

#include <cerrno>
#include <system_error>

namespace leafhull {
namespace {

[[noreturn]] void fail() { throw std::system_error(errno, std::generic_category()); }

}  // namespace

MemoryFile::MemoryFile() : descriptor_(::memfd_create("leafhull", MFD_CLOEXEC)) {
  if (descriptor_ < 0) fail();
}

MemoryFile::~MemoryFile() { ::close(descriptor_); }

void MemoryFile::write(std::string_view text) const {
  while (!text.empty()) {
    const ssize_t count = ::write(descriptor_, text.data(), text.size());
    if (count < 0 && errno != EINTR) fail();
    if (count > 0) text.remove_prefix(static_cast<std::size_t>(count));
  }
  ::lseek(descriptor_, 0, SEEK_SET);
}

std::string MemoryFile::read() const {
  std::string text(static_cast<std::size_t>(::lseek(descriptor_, 0, SEEK_END)), '\0');
  std::size_t done = 0;
  while (done < text.size()) {
    const auto at = static_cast<off_t>(done);
    const ssize_t count = ::pread(descriptor_, &text[done], text.size() - done, at);
    if (count < 0 && errno != EINTR) fail();
    if (count > 0) done += static_cast<std::size_t>(count);
  }
  return text;
}

}  // namespace leafhull
