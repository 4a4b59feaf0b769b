// SPDX-License-Identifier: Apache-2.0
#include "runs/sealed_lines.h"

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include <cerrno>
#include <utility>

#include "leafhull/error.h"
#include "output/temporary_file.h"
#include "output/write_error.h"
#include "runs/read_file.h"

namespace leafhull {
namespace {

std::vector<std::string> split(std::string_view text) {
  std::vector<std::string> lines;
  for (std::size_t end = text.find('\n'); end != std::string_view::npos; end = text.find('\n')) {
    lines.emplace_back(text.substr(0, end));
    text.remove_prefix(end + 1);
  }
  return lines;
}

}  // namespace

SealedLines::SealedLines(std::filesystem::path file, const std::string& rival)
    : file_(std::move(file)) {
  descriptor_ = ::open(file_.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0666);
  if (descriptor_ < 0) throw write_error(file_, errno);
  try {
    if (::flock(descriptor_, LOCK_EX | LOCK_NB) != 0 && errno == EWOULDBLOCK) {
      throw Error(ErrorCode::usage, file_.string() + " is in use: " + rival + " is writing to it",
                  "Wait for it, or name another folder.");
    }
    std::string text;
    const auto take = [&](std::string_view piece) { text += piece; };
    if (const int reason = read_rest(descriptor_, take)) throw write_error(file_, reason);
    empty_ = text.empty();
    lines_ = split(text);
    size_ = static_cast<off_t>(text.rfind('\n') + 1);  // npos + 1 is 0
    sync_folder(file_.parent_path());
  } catch (...) {
    ::close(descriptor_);
    throw;
  }
}

SealedLines::~SealedLines() { ::close(descriptor_); }

void SealedLines::clear() {
  truncate(0);
  empty_ = true;
}

void SealedLines::truncate(off_t size) {
  if (::ftruncate(descriptor_, size) != 0) throw write_error(file_, errno);
  size_ = size;
}

void SealedLines::append(Json object) {
  const std::string text = dumped(sealed(std::move(object))) + "\n";
  truncate(size_);  // drops what a crash left behind the last whole line
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
  if (::fsync(descriptor_) != 0 && errno != EINVAL) {
    const int reason = errno;
    truncate(size_);
    throw write_error(file_, reason);
  }
  size_ += static_cast<off_t>(text.size());
  empty_ = false;
}

std::vector<std::string> whole_lines(const std::filesystem::path& file) {
  return split(content_of(file));
}

}  // namespace leafhull
