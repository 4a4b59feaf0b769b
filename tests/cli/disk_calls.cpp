// SPDX-License-Identifier: Apache-2.0
// Loaded before the C library (LD_PRELOAD). Logs the calls that decide what a power cut leaves, one
// per line, to the file that DISK_CALLS names. If DISK_CALLS_FAIL is set, every fsync fails.
#include <fcntl.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <climits>
#include <cstdlib>
#include <string>

namespace {

std::string path_of(int descriptor) {
  const int reason = errno;
  const std::string link = "/proc/self/fd/" + std::to_string(descriptor);
  std::array<char, PATH_MAX> path;
  const ssize_t size = ::readlink(link.c_str(), path.data(), path.size());
  errno = reason;
  return {path.data(), static_cast<std::size_t>(size > 0 ? size : 0)};
}

/// Logs a call; leaves errno unchanged.
void note(const std::string& call, const std::string& file, const std::string& name = "") {
  const int reason = errno;
  static const char* const log = std::getenv("DISK_CALLS");
  const int descriptor = log ? ::open(log, O_WRONLY | O_APPEND | O_CREAT | O_CLOEXEC, 0666) : -1;
  if (descriptor >= 0) {
    const std::string line = call + "\t" + file + "\t" + name + "\n";
    ::syscall(SYS_write, descriptor, line.data(), line.size());
    ::close(descriptor);
  }
  errno = reason;
}

}  // namespace

extern "C" {

ssize_t write(int descriptor, const void* data, std::size_t size) {
  note("write", path_of(descriptor));
  return ::syscall(SYS_write, descriptor, data, size);
}

ssize_t pwrite(int descriptor, const void* data, std::size_t size, off_t offset) {
  note("write", path_of(descriptor));
  return ::syscall(SYS_pwrite64, descriptor, data, size, offset);
}

int fsync(int descriptor) {
  if (std::getenv("DISK_CALLS_FAIL")) {
    errno = EIO;
    return -1;
  }
  note("fsync", path_of(descriptor));
  return static_cast<int>(::syscall(SYS_fsync, descriptor));
}

int renameat2(int from, const char* file, int to, const char* name, unsigned flags) noexcept {
  const auto result = static_cast<int>(::syscall(SYS_renameat2, from, file, to, name, flags));
  if (result == 0) note((flags & 2) != 0 ? "exchange" : "rename", file, name);
  return result;
}

int rename(const char* file, const char* name) noexcept {
  return ::renameat2(AT_FDCWD, file, AT_FDCWD, name, 0);
}

int link(const char* file, const char* name) noexcept {
  const auto result = static_cast<int>(::syscall(SYS_linkat, AT_FDCWD, file, AT_FDCWD, name, 0));
  if (result == 0) note("link", file, name);
  return result;
}
}
