// SPDX-License-Identifier: Apache-2.0
#include "picture/style.h"

#include <algorithm>
#include <cerrno>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <system_error>

#include "leafhull/error.h"
#include "text/file_name.h"

namespace leafhull {
namespace {

namespace fs = std::filesystem;

std::string read_text(const fs::path& file) {
  constexpr const char* kRemedy = "Give the path of a .json style that you may read.";
  std::error_code missing;
  if (fs::is_directory(file, missing)) {
    throw Error(ErrorCode::input, file.string() + ": cannot be read: it is a folder", kRemedy);
  }
  errno = 0;
  std::ifstream stream(file, std::ios::binary);
  std::string text{std::istreambuf_iterator<char>(stream), {}};
  if (!stream) {
    const std::string reason = std::generic_category().message(errno);
    throw Error(ErrorCode::input, file.string() + ": cannot be read: " + reason, kRemedy);
  }
  return text;
}

}  // namespace

std::span<const std::string_view> watercolour_styles() { return watercolour::style_names(); }

std::string watercolour_style_table() { return watercolour::style_table(); }

WatercolourStyle::WatercolourStyle(const std::string& name_or_file, std::optional<double> detail) {
  const auto shipped = watercolour::style_names();
  const bool is_name = std::ranges::find(shipped, name_or_file) != shipped.end();
  watercolour::Style style = !is_name && looks_like_file(name_or_file)
                                 ? watercolour::parse_style(read_text(name_or_file), name_or_file)
                                 : watercolour::shipped_style(name_or_file);
  if (detail) style.detail = static_cast<float>(*detail);
  keys_ = std::make_shared<const Keys>(Keys{style});
}

}  // namespace leafhull
