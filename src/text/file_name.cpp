// SPDX-License-Identifier: Apache-2.0
#include "text/file_name.h"

#include <system_error>

#include "text/text.h"

namespace leafhull {

namespace fs = std::filesystem;

std::string lower_extension(const fs::path& file) {
  return in_lower_case(file.extension().string());
}

bool looks_like_file(const std::string& word) {
  const fs::path file(word);
  std::error_code unreadable;
  return file.has_extension() || file.has_parent_path() || fs::exists(file, unreadable);
}

}  // namespace leafhull
