// SPDX-License-Identifier: Apache-2.0
#include "output/line_file.h"

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <system_error>
#include <utility>

#include "leafhull/error.h"
#include "output/write_error.h"

namespace leafhull {
namespace {

namespace fs = std::filesystem;

/// All that is left to read; errno where that fails.
int read_all(int descriptor, std::string& text) {
  std::array<char, 1 << 16> buffer;
  for (;;) {
    const ssize_t count = ::read(descriptor, buffer.data(), buffer.size());
    if (count == 0) return 0;
    if (count > 0) {
      text.append(buffer.data(), static_cast<std::size_t>(count));
    } else if (errno != EINTR) {
      return errno;
    }
  }
}

std::vector<std::string> split(std::string_view text) {
  std::vector<std::string> lines;
  for (std::size_t end = text.find('\n'); end != std::string_view::npos; end = text.find('\n')) {
    lines.emplace_back(text.substr(0, end));
    text.remove_prefix(end + 1);
  }
  return lines;
}

}  // namespace

LineFile::LineFile(fs::path file, const std::string& rival) : file_(std::move(file)) {
  descriptor_ = ::open(file_.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0666);
  if (descriptor_ < 0) throw write_error(file_, errno);
  try {
    if (::flock(descriptor_, LOCK_EX | LOCK_NB) != 0 && errno == EWOULDBLOCK) {
      throw Error(ErrorCode::usage, file_.string() + " is in use: " + rival + " is writing to it",
                  "Wait for it, or name another folder.");
    }
    std::string text;
    if (const int reason = read_all(descriptor_, text)) throw write_error(file_, reason);
    empty_ = text.empty();
    lines_ = split(text);
    size_ = static_cast<off_t>(text.rfind('\n') + 1);  // npos + 1 is 0
  } catch (...) {
    ::close(descriptor_);
    throw;
  }
}

LineFile::~LineFile() { ::close(descriptor_); }

void LineFile::clear() {
  truncate(0);
  empty_ = true;
}

void LineFile::truncate(off_t size) {
  if (::ftruncate(descriptor_, size) != 0) throw write_error(file_, errno);
  size_ = size;
}

void LineFile::append(std::string_view line) {
  const std::string text = std::string(line) + "\n";
  truncate(size_);  // of what a crash has left behind the last whole line
  std::size_t done = 0;
  while (done < text.size()) {
    const ssize_t count = ::pwrite(descriptor_, text.data() + done, text.size() - done,
                                   size_ + static_cast<off_t>(done));
    if (count < 0 && errno == EINTR) continue;
    const int reason = errno;
    if (count < 0) {
      truncate(size_);
      throw write_error(file_, reason);
    }
    done += static_cast<std::size_t>(count);
  }
  if (::fsync(descriptor_) != 0 && errno != EINVAL) throw write_error(file_, errno);
  size_ += static_cast<off_t>(text.size());
  empty_ = false;
}

std::vector<std::string> whole_lines(const fs::path& file) {
  std::string text;
  const int descriptor = ::open(file.c_str(), O_RDONLY | O_CLOEXEC);
  int reason = errno;
  if (descriptor >= 0) {
    reason = read_all(descriptor, text);
    ::close(descriptor);
  }
  if (reason != 0) {
    throw Error(ErrorCode::input,
                "cannot read " + file.string() + ": " + std::generic_category().message(reason),
                "Check the disk and the file's permissions.");
  }
  return split(text);
}

}  // namespace leafhull
