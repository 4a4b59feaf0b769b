// SPDX-License-Identifier: Apache-2.0
#include "input/obj_text.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

#include "text/numbers.h"

namespace leafhull {
namespace {

constexpr std::string_view kBlanks = " \t";

/// Keywords in lower case, and as tinyobjloader expects them.
constexpr std::array<std::pair<std::string_view, std::string_view>, 14> kKeywords{
    {{"v", "v"},
     {"vn", "vn"},
     {"vt", "vt"},
     {"f", "f"},
     {"g", "g"},
     {"o", "o"},
     {"usemtl", "usemtl"},
     {"mtllib", "mtllib"},
     {"newmtl", "newmtl"},
     {"kd", "Kd"},
     {"map_kd", "map_Kd"},
     {"map_d", "map_d"},
     {"d", kDissolve},
     {"tr", kTransparency}}};

std::string_view keyword_for(std::string_view word) {
  const auto lower = [](char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c + 32) : c; };
  for (const auto& [small, keyword] : kKeywords) {
    if (std::ranges::equal(word, small, {}, lower)) return keyword;
  }
  return word;
}

/// The next line, which ends in LF, CR or both.
std::string_view take_raw_line(std::string_view& text) {
  const std::size_t length = std::min(text.find_first_of("\r\n"), text.size());
  const std::string_view line = text.substr(0, length);
  text.remove_prefix(
      std::min(length + (text.substr(length).starts_with("\r\n") ? 2 : 1), text.size()));
  return line;
}

// A comment may end with the path of a folder.
bool is_continued(std::string_view line) {
  return line.ends_with('\\') && !trimmed(line).starts_with('#');
}

void append_line(std::string_view line, std::string& text) {
  const std::string_view word = take_word(line);
  text += keyword_for(word);
  if (line.empty()) return;
  text += ' ';
  text += line.substr(std::min(line.find_first_not_of(kBlanks), line.size()));
}

}  // namespace

std::string obj_text(std::string_view written) {
  if (written.starts_with("\xEF\xBB\xBF")) written.remove_prefix(3);
  std::string text, joined;
  text.reserve(written.size() + 1);
  while (!written.empty()) {
    std::string_view line = take_raw_line(written);
    std::size_t breaks = 1;
    if (is_continued(line)) {
      joined.clear();
      for (; is_continued(line) && !written.empty(); ++breaks) {
        line.remove_suffix(1);
        (joined += line) += ' ';
        line = take_raw_line(written);
      }
      line = joined += line;
    }
    append_line(line, text);
    text.append(breaks, '\n');
  }
  return text;
}

std::string_view take_line(std::string_view& text) {
  const std::string_view line = text.substr(0, text.find('\n'));
  text.remove_prefix(std::min(line.size() + 1, text.size()));
  return line;
}

std::string_view take_word(std::string_view& line) {
  line.remove_prefix(std::min(line.find_first_not_of(kBlanks), line.size()));
  const std::string_view word = line.substr(0, line.find_first_of(kBlanks));
  line.remove_prefix(word.size());
  return word;
}

std::string_view trimmed(std::string_view text) {
  const std::size_t first = text.find_first_not_of(kBlanks);
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(kBlanks) - first + 1);
}

double finite_number(std::string_view word) {
  constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
  if (word.starts_with('+') && !word.starts_with("+-")) word.remove_prefix(1);
  const double value = parsed<double>(word).value_or(kNaN);
  return std::isfinite(value) ? value : kNaN;
}

}  // namespace leafhull
