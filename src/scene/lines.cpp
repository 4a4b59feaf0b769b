// SPDX-License-Identifier: Apache-2.0
#include "scene/lines.h"

#include <cerrno>
#include <system_error>

#include "leafhull/error.h"

namespace leafhull {
namespace {

[[noreturn]] void fail(const std::filesystem::path& file, std::error_code why) {
  throw Error(ErrorCode::input, file.string() + ": cannot be read: " + why.message(),
              "Give the path of a .csv or .jsonl file that you may read.");
}

}  // namespace

std::ifstream open_text(const std::filesystem::path& file) {
  std::ifstream stream(file, std::ios::binary);
  if (!stream) fail(file, {errno, std::generic_category()});
  std::error_code unknown;
  if (std::filesystem::is_directory(file, unknown)) {
    fail(file, std::make_error_code(std::errc::is_a_directory));
  }
  return stream;
}

bool Lines::next() {
  while (std::getline(stream_, text_)) {
    ++number_;
    if (number_ == 1 && (text_.starts_with("\xFF\xFE") || text_.starts_with("\xFE\xFF"))) {
      throw Error(ErrorCode::input, file_.string() + ": is UTF-16 text", "Save it as UTF-8.");
    }
    if (number_ == 1 && text_.starts_with("\xEF\xBB\xBF")) text_.erase(0, 3);
    if (text_.ends_with('\r')) text_.pop_back();
    const std::size_t first = text_.find_first_not_of(" \t");
    if (first != std::string::npos && text_[first] != '#') return true;
  }
  if (stream_.bad()) fail(file_, {errno, std::generic_category()});
  return false;
}

}  // namespace leafhull
