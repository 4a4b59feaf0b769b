// SPDX-License-Identifier: Apache-2.0
#include "scene/csv.h"

#include <algorithm>
#include <array>

#include "scene/scatter_row.h"

namespace leafhull {
namespace {

constexpr std::string_view kBlanks = " \t";

std::size_t skip_blanks(std::string_view line, char separator, std::size_t at) {
  while (at < line.size() && line[at] != separator && kBlanks.find(line[at]) != kBlanks.npos) ++at;
  return at;
}

/// The text between quotes. `at` is at the first quote and then moves behind the last.
std::string_view quoted_field(std::string& line, std::size_t& at) {
  const std::size_t begin = ++at;
  std::size_t end = begin;
  for (;; ++at) {
    if (at == line.size()) throw BadRow{"a quote is not closed", "Close it on its line."};
    if (line[at] == '"' && (++at == line.size() || line[at] != '"')) break;
    line[end++] = line[at];
  }
  return std::string_view(line).substr(begin, end - begin);
}

}  // namespace

char separator_of(std::string_view line) {
  constexpr std::string_view kSeparators = ";,\t";
  std::array<int, kSeparators.size()> counts{};
  bool quoted = false;
  for (const char c : line) {
    if (c == '"') quoted = !quoted;
    const std::size_t kind = kSeparators.find(c);
    if (!quoted && kind != kSeparators.npos) ++counts[kind];
  }
  // Beside another separator, tabs are blanks.
  if (counts[0] > 0 || counts[1] > 0) counts[2] = 0;
  return kSeparators[std::ranges::max_element(counts) - counts.begin()];
}

void split_csv(std::string& line, char separator, std::vector<std::string_view>& fields) {
  fields.clear();
  for (std::size_t at = 0;; ++at) {
    at = skip_blanks(line, separator, at);
    if (at < line.size() && line[at] == '"') {
      fields.push_back(quoted_field(line, at));
      at = skip_blanks(line, separator, at);
      if (at < line.size() && line[at] != separator) {
        throw BadRow{"text follows a quoted field", "Write a quote within quotes twice."};
      }
    } else {
      const std::size_t begin = at;
      at = std::min(line.find(separator, at), line.size());
      const std::string_view field = std::string_view(line).substr(begin, at - begin);
      fields.push_back(field.substr(0, field.find_last_not_of(kBlanks) + 1));
    }
    if (at == line.size()) return;
  }
}

std::string csv_field(std::string_view text) {
  const bool plain = !text.empty() && text.find_first_of(",\"") == std::string_view::npos &&
                     text.front() != '#' && kBlanks.find(text.front()) == std::string_view::npos &&
                     kBlanks.find(text.back()) == std::string_view::npos;
  if (plain) return std::string(text);
  std::string field = "\"";
  for (const char c : text) field += c == '"' ? std::string("\"\"") : std::string(1, c);
  return field + '"';
}

}  // namespace leafhull
