// SPDX-License-Identifier: Apache-2.0
#include "cli/values.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <charconv>
#include <cmath>
#include <cstdio>
#include <numeric>
#include <optional>
#include <type_traits>
#include <utility>

#include "leafhull/error.h"

namespace leafhull::cli {
namespace {

template <class Number>
std::optional<Number> parsed(std::string_view text) {
  Number value{};
  const char* end = text.data() + text.size();
  const auto result = std::from_chars(text.data(), end, value);
  if (result.ec != std::errc() || result.ptr != end) return {};
  return value;
}

[[noreturn]] void refuse(std::string_view flag, std::string_view text, const std::string& why,
                         const std::string& remedy) {
  throw Error(ErrorCode::usage, std::string(flag) + " '" + std::string(text) + "' " + why, remedy);
}

double real_number(std::string_view flag, std::string_view text) {
  const std::optional<double> value = parsed<double>(text);
  if (!value) refuse(flag, text, "is not a number", "Give a number such as 1.5.");
  return *value;
}

void assign(bool& value, std::string_view, const std::string&) { value = !value; }

void assign(double& value, std::string_view flag, const std::string& text) {
  value = real_number(flag, text);
}

void assign(int& value, std::string_view flag, const std::string& text) {
  const std::optional<int> whole = parsed<int>(text);
  if (!whole) refuse(flag, text, "is not a whole number", "Give a number such as 2.");
  value = *whole;
}

void assign(Style& value, std::string_view flag, const std::string& text) {
  // The name that it had up to 0.1.
  value = text == "luft-deussen" ? Style::paper_previous
                                 : static_cast<Style>(choice(flag, text, names(value)));
}

template <class Enum>
requires std::is_enum_v<Enum>
void assign(Enum& value, std::string_view flag, const std::string& text) {
  value = static_cast<Enum>(choice(flag, text, names(value)));
}

void assign(std::vector<std::string>& value, std::string_view, const std::string& text) {
  value.push_back(text);
}

void assign(TextureEllipse& value, std::string_view flag, const std::string& text) {
  std::array<double, 6> n;
  std::size_t from = 0;
  for (std::size_t i = 0; i < n.size(); ++i) {
    const std::size_t comma = text.find(',', from);
    if ((comma == std::string::npos) != (i + 1 == n.size())) {
      refuse(flag, text, "is not six numbers",
             "Give the centre and two half-axes as cu,cv,au,av,bu,bv.");
    }
    n[i] = real_number(flag, std::string_view(text).substr(from, comma - from));
    from = comma + 1;
  }
  value = {{n[0], n[1]}, {n[2], n[3]}, {n[4], n[5]}};
}

void assign(Srgb& value, std::string_view flag, const std::string& text) {
  constexpr std::string_view kDigits = "0123456789abcdefABCDEF";
  if (text.size() != 7 || text[0] != '#' || text.find_first_not_of(kDigits, 1) != text.npos) {
    refuse(flag, text, "is not a colour", "Give it as '#rrggbb'.");
  }
  for (std::size_t i = 0; i < value.size(); ++i) {
    const std::string digits = text.substr(1 + 2 * i, 2);
    value[i] = static_cast<std::uint8_t>(std::stoul(digits, nullptr, 16));
  }
}

void assign(LeafColour& value, std::string_view flag, const std::string& text) {
  const std::size_t comma = text.find(',');
  assign(value.srgb, flag, text.substr(0, comma));
  if (comma == text.npos) return;
  value.tolerance = real_number(flag, std::string_view(text).substr(comma + 1));
  if (!(value.tolerance > 0)) {
    refuse(flag, text, "has a tolerance that is not positive", "Distances in Oklab are 0.02 to 1.");
  }
}

template <class Value>
void assign(std::optional<Value>& value, std::string_view flag, const std::string& text) {
  assign(value.emplace(), flag, text);
}

std::size_t edit_distance(std::string_view a, std::string_view b) {
  std::vector<std::size_t> row(b.size() + 1);
  std::iota(row.begin(), row.end(), 0);
  for (std::size_t i = 0; i < a.size(); ++i) {
    std::size_t diagonal = std::exchange(row[0], i + 1);
    for (std::size_t j = 0; j < b.size(); ++j) {
      const std::size_t replaced = diagonal + (a[i] != b[j]);
      diagonal = row[j + 1];
      row[j + 1] = std::min({replaced, row[j] + 1, diagonal + 1});
    }
  }
  return row.back();
}

std::string print(const char* format, int precision, double value) {
  std::array<char, 64> buffer;
  std::snprintf(buffer.data(), buffer.size(), format, precision, value);
  return buffer.data();
}

}  // namespace

void set_option(Options& options, const OptionRow& row, const std::string& text) {
  const std::string flag = "--" + std::string(row.name);
  if (!text.ends_with('%') || !takes_percent(row)) {
    std::visit([&](auto member) { assign(options.*member, flag, text); }, row.member);
    return;
  }
  const double percent = real_number(flag, std::string_view(text).substr(0, text.size() - 1));
  const bool fraction = row.percent.empty();
  const OptionRow& target = fraction ? row : option_row(row.percent);
  options.*std::get<std::optional<double> Options::*>(target.member) =
      fraction ? percent / 100 : percent;
}

int whole_number(std::string_view flag, const std::string& text, int low, int high) {
  const std::optional<int> value = parsed<int>(text);
  if (!value || *value < low || *value > high) {
    refuse(flag, text, "is out of range",
           "Give a whole number from " + std::to_string(low) + " to " + std::to_string(high) + ".");
  }
  return *value;
}

double real_number(std::string_view flag, const std::string& text, double low, double high) {
  const double value = real_number(flag, text);
  if (std::isnan(value) || value < low || value > high) {
    refuse(flag, text, "is out of range",
           std::string("Give a number from ") + number(low) + " to " + number(high) + ".");
  }
  return value;
}

std::uint64_t byte_count(std::string_view flag, const std::string& text, std::uint64_t low) {
  constexpr std::string_view kUnits = "KMGT";
  constexpr double kMost = 1LL << 60;
  std::string_view digits = text;
  double unit = 1;
  if (!text.empty()) {
    const std::size_t power =
        kUnits.find(static_cast<char>(std::toupper(static_cast<unsigned char>(text.back()))));
    if (power != std::string_view::npos) {
      unit = std::exp2(10 * static_cast<double>(power + 1));
      digits.remove_suffix(1);
    }
  }
  const double size = parsed<double>(digits).value_or(-1) * unit;
  if (std::isnan(size) || size < 0 || size >= kMost) {
    refuse(flag, text, "is not a size", "Give bytes, or a number with K, M, G or T, such as 4G.");
  }
  const auto whole = static_cast<std::uint64_t>(size);
  if (whole < low) refuse(flag, text, "is too little", "Give " + bytes(low) + " or more.");
  return whole;
}

std::size_t choice(std::string_view flag, std::string_view text,
                   std::span<const std::string_view> valid) {
  const auto found = std::find(valid.begin(), valid.end(), text);
  if (found == valid.end()) {
    const std::string_view near = nearest(text, valid);
    const std::string guess = near.empty() ? "" : "Did you mean " + std::string(near) + "? ";
    refuse(flag, text, "is unknown", guess + "Choose from: " + joined(valid, ", ") + ".");
  }
  return static_cast<std::size_t>(found - valid.begin());
}

std::string_view nearest(std::string_view text, std::span<const std::string_view> valid) {
  std::string_view best;
  std::size_t best_distance = std::max<std::size_t>(2, text.size() / 3) + 1;
  for (const std::string_view candidate : valid) {
    const std::size_t distance = edit_distance(text, candidate);
    if (distance < best_distance) best = candidate, best_distance = distance;
  }
  return best;
}

std::string joined(std::span<const std::string_view> words, std::string_view separator) {
  std::string text;
  for (const std::string_view word : words) {
    if (word.empty()) continue;
    if (!text.empty()) text += separator;
    text += word;
  }
  return text;
}

std::string number(double value, int digits) { return print("%.*g", digits, value); }

std::string seconds(double value) { return print("%.*f s", value < 1 ? 3 : 2, value); }

std::string bytes(std::uint64_t value) {
  const double mebibytes = std::ldexp(static_cast<double>(value), -20);
  return mebibytes < 1024 ? print("%.*f MiB", 0, mebibytes)
                          : print("%.*g GiB", 3, mebibytes / 1024);
}

std::string count(std::uint64_t value) {
  std::string text = std::to_string(value);
  for (auto at = static_cast<std::ptrdiff_t>(text.size()) - 3; at > 0; at -= 3) {
    text.insert(static_cast<std::size_t>(at), 1, ',');
  }
  return text;
}

std::string quoted(const std::string& word) {
  const bool plain = !word.empty() && std::all_of(word.begin(), word.end(), [](unsigned char c) {
    return std::isalnum(c) != 0 ||
           std::string_view("/._-+,:@%").find(static_cast<char>(c)) != std::string_view::npos;
  });
  if (plain) return word;
  std::string text = "'";
  for (const char c : word) text += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return text + "'";
}

}  // namespace leafhull::cli
