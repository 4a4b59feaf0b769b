// SPDX-License-Identifier: Apache-2.0
#include "sweep/journal.h"

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <string>
#include <string_view>
#include <utility>

#include "leafhull/error.h"
#include "output/write_error.h"
#include "sweep/plan.h"

namespace leafhull {
namespace {

namespace fs = std::filesystem;

std::string content_of(int descriptor, const fs::path& file) {
  std::string text;
  std::array<char, 1 << 16> buffer;
  for (;;) {
    const ssize_t count = ::read(descriptor, buffer.data(), buffer.size());
    if (count < 0 && errno == EINTR) continue;
    if (count < 0) throw write_error(file, errno);
    if (count == 0) return text;
    text.append(buffer.data(), static_cast<std::size_t>(count));
  }
}

Json parsed(std::string_view line) { return Json::parse(line, nullptr, false); }

bool is_row(const Json& line) {
  return line.is_object() && line.contains("row") && line["row"].is_number_unsigned() &&
         line.contains("picture") && line["picture"].is_string();
}

}  // namespace

Journal::Journal(fs::path file) : file_(std::move(file)) {
  descriptor_ = ::open(file_.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0666);
  if (descriptor_ < 0) throw write_error(file_, errno);
  try {
    if (::flock(descriptor_, LOCK_EX | LOCK_NB) != 0 && errno == EWOULDBLOCK) {
      throw Error(ErrorCode::usage, file_.string() + " is in use: another sweep is writing to it",
                  "Wait for it, or name another folder.");
    }
    read();
  } catch (...) {
    ::close(descriptor_);
    throw;
  }
}

Journal::~Journal() { ::close(descriptor_); }

void Journal::read() {
  const std::string text = content_of(descriptor_, file_);
  std::string_view rest = text;
  for (std::size_t end = rest.find('\n'); end != std::string_view::npos; end = rest.find('\n')) {
    Json line = parsed(rest.substr(0, end));
    if (size_ == 0) {
      header_ = std::move(line);
    } else if (is_row(line)) {
      rows_.insert_or_assign(line["row"].get<std::size_t>(), std::move(line));
    }
    size_ += static_cast<off_t>(end) + 1;
    rest.remove_prefix(end + 1);
  }
  const bool is_journal = text.empty() || (header_.is_object() && header_.contains("schema") &&
                                           header_["schema"] == kJournalSchema);
  if (!is_journal) {
    throw Error(ErrorCode::usage, file_.string() + " is not the journal of a sweep",
                "Name another folder, or move that file away.");
  }
}

void Journal::begin(const Json& header) {
  truncate(0);
  rows_.clear();
  header_ = Json();
  write_line(header);
  header_ = header;
}

void Journal::append(Json row) {
  write_line(row);
  rows_.insert_or_assign(row["row"].get<std::size_t>(), std::move(row));
}

void Journal::truncate(off_t size) {
  if (::ftruncate(descriptor_, size) != 0) throw write_error(file_, errno);
  size_ = size;
}

void Journal::write_line(const Json& line) {
  // The input's name need not be UTF-8.
  const std::string text = line.dump(-1, ' ', false, Json::error_handler_t::replace) + "\n";
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
}

}  // namespace leafhull
