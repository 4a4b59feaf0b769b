// SPDX-License-Identifier: Apache-2.0
#include "cli/values.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <optional>
#include <utility>

#include "leafhull/error.h"
#include "text/numbers.h"

namespace leafhull::cli {
namespace {

[[noreturn]] void refuse(const Typed& typed, const std::string& why, const std::string& remedy) {
  throw Error(ErrorCode::usage, typed.flag + " '" + typed.text + "' " + why, remedy);
}

double real_number(const Typed& typed, std::string_view text) {
  const std::optional<double> value = parsed<double>(text);
  if (!value) {
    const std::string part(text);
    refuse({typed.line, part, typed.flag}, "is not a number", "Give a number such as 1.5.");
  }
  return *value;
}

/// A part of what was typed, with a name of its own for messages.
template <class Value>
void parse_part(Value& value, const Typed& typed, const std::string& part, const char* name = "") {
  parse(value, {typed.line, part, typed.flag + name, typed.in_range});
}

template <class Whole>
void parse_whole(Whole& value, const Typed& typed) {
  const std::optional<Whole> whole = parsed<Whole>(typed.text);
  const auto& [low, high] = std::pair(typed.line.low, typed.line.high);
  if (!typed.in_range) {
    if (!whole) refuse(typed, "is not a whole number", "Give a number such as 2.");
  } else if (!whole || static_cast<double>(*whole) < low || static_cast<double>(*whole) > high) {
    refuse(typed, "is out of range",
           "Give a whole number from " + std::to_string(std::llround(low)) + " to " +
               std::to_string(std::llround(high)) + ".");
  }
  value = *whole;
}

}  // namespace

void parse(bool& value, const Typed&) { value = !value; }

void parse(int& value, const Typed& typed) {
  parse_whole(value, typed);
  if (typed.in_range) check_value(typed.line, value);  // for its step
}

void parse(std::uint64_t& value, const Typed& typed) { parse_whole(value, typed); }

void parse(double& value, const Typed& typed) {
  value = real_number(typed, typed.text);
  if (!typed.in_range) return;
  const auto [low, high] = std::pair(typed.line.low, typed.line.high);
  if (std::isnan(value) || value < low || value > high) {
    refuse(typed, "is out of range",
           "Give a number from " + number(low) + " to " + number(high) + ".");
  }
}

void parse(ByteCount& value, const Typed& typed) {
  constexpr std::string_view kUnits = "KMGT";
  constexpr double kMost = 1LL << 60;
  std::string_view digits = typed.text;
  double unit = 1;
  if (!digits.empty()) {
    const std::size_t power =
        kUnits.find(static_cast<char>(std::toupper(static_cast<unsigned char>(digits.back()))));
    if (power != std::string_view::npos) {
      unit = std::exp2(10 * static_cast<double>(power + 1));
      digits.remove_suffix(1);
    }
  }
  const double size = parsed<double>(digits).value_or(-1) * unit;
  if (std::isnan(size) || size < 0 || size >= kMost) {
    refuse(typed, "is not a size", "Give bytes, or a number with K, M, G or T, such as 4G.");
  }
  value.bytes = static_cast<std::uint64_t>(size);
  if (size < typed.line.low) {
    const auto least = static_cast<std::uint64_t>(typed.line.low);
    refuse(typed, "is too small", "Give " + bytes(least) + " or more.");
  }
}

void parse(std::string& value, const Typed& typed) {
  if (typed.line.value == "NAME" && !typed.line.choices.empty()) {
    choice(typed.flag, typed.text, typed.line.choices);
  }
  value = typed.text;
}

void parse(std::filesystem::path& value, const Typed& typed) { value = typed.text; }

void parse(Vec2d& value, const Typed& typed) {
  const std::size_t cross = typed.text.find('x');
  if (cross == std::string::npos) {
    refuse(typed, "is not two numbers", "Give its sides along x and z, such as 200x100.");
  }
  parse_part(value.x, typed, typed.text.substr(0, cross));
  parse_part(value.y, typed, typed.text.substr(cross + 1));
}

void parse(Srgb& value, const Typed& typed) {
  constexpr std::string_view kDigits = "0123456789abcdefABCDEF";
  const std::string& text = typed.text;
  if (text.size() != 7 || text[0] != '#' || text.find_first_not_of(kDigits, 1) != text.npos) {
    refuse(typed, "is not a colour", "Give it as '#rrggbb'.");
  }
  for (std::size_t i = 0; i < value.size(); ++i) {
    const std::string digits = text.substr(1 + 2 * i, 2);
    value[i] = static_cast<std::uint8_t>(std::stoul(digits, nullptr, 16));
  }
}

void parse(LeafColour& value, const Typed& typed) {
  const std::size_t comma = typed.text.find(',');
  parse_part(value.srgb, typed, typed.text.substr(0, comma));
  if (comma == std::string::npos) return;
  value.tolerance = real_number(typed, std::string_view(typed.text).substr(comma + 1));
  if (!(value.tolerance > 0)) {
    refuse(typed, "has a tolerance that is not positive", "Distances in Oklab are 0.02 to 1.");
  }
}

void parse(TextureEllipse& value, const Typed& typed) {
  const std::string& text = typed.text;
  std::array<double, 6> n;
  std::size_t from = 0;
  for (std::size_t i = 0; i < n.size(); ++i) {
    const std::size_t comma = text.find(',', from);
    if ((comma == std::string::npos) != (i + 1 == n.size())) {
      refuse(typed, "is not six numbers",
             "Give the centre and two half-axes as cu,cv,au,av,bu,bv.");
    }
    n[i] = real_number(typed, std::string_view(text).substr(from, comma - from));
    from = comma + 1;
  }
  value = {{n[0], n[1]}, {n[2], n[3]}, {n[4], n[5]}};
}

void parse(TileRange& value, const Typed& typed) {
  const std::string& text = typed.text;
  const std::size_t slash = text.find('/');
  if (slash == std::string::npos) {
    refuse(typed, "is not I/N", "Give the part and how many there are, such as 1/4.");
  }
  parse_part(value.parts, typed, text.substr(slash + 1), ", N");
  const std::string part = text.substr(0, slash), parts = std::to_string(value.parts);
  if (part == "0") {
    throw Error(ErrorCode::usage, typed.flag + " " + text + " begins at 0",
                "Ranges count from 1: give 1/" + parts + " to " + parts + "/" + parts + ".");
  }
  OptionLine of_parts = typed.line;
  of_parts.high = value.parts;
  parse_part(value.part, {of_parts, text}, part, ", I");
}

void parse(Style& value, const Typed& typed) { value = style_named(typed.text); }

void parse(Plate& value, const Typed& typed) {
  value = typed.text.empty() ? Plate::own : Plate::paper;
}

void parse(int& width, int& height, const Typed& typed) {
  const std::size_t cross = typed.text.find('x');
  if (cross == std::string::npos) {
    refuse(typed, "is not WIDTHxHEIGHT", "Give both in pixels, such as 1024x768.");
  }
  parse_part(width, typed, typed.text.substr(0, cross), ", width");
  parse_part(height, typed, typed.text.substr(cross + 1), ", height");
}

void parse(double& low, double& high, const Typed& typed) {
  const std::size_t colon = typed.text.find(':');
  if (colon == std::string::npos) {
    refuse(typed, "is not two numbers", "Give LOW:HIGH, such as 0.8:1.2, or 1:1.");
  }
  parse_part(low, typed, typed.text.substr(0, colon));
  parse_part(high, typed, typed.text.substr(colon + 1));
}

void set_option(Options& options, const OptionRow& row, const std::string& text) {
  if (!text.ends_with('%') || !takes_percent(row)) {
    set_value(options, row, {.line = row, .text = text, .in_range = false});
    return;
  }
  const double percent =
      real_number({row, text}, std::string_view(text).substr(0, text.size() - 1));
  const bool fraction = row.percent.empty();
  const OptionRow& target = fraction ? row : option_row(row.percent);
  options.*std::get<std::optional<double> Options::*>(target.member) =
      fraction ? percent / 100 : percent;
}

std::string seconds(double value) { return fixed(value, value < 1 ? 3 : 2) + " s"; }

std::string bytes(std::uint64_t value) {
  const double mebibytes = std::ldexp(static_cast<double>(value), -20);
  return mebibytes < 1024 ? fixed(mebibytes, 0) + " MiB"
                          : significant(mebibytes / 1024, 3) + " GiB";
}

std::string per_second(std::uint64_t leaf_vertices, double seconds) {
  const double pace = seconds > 0 ? static_cast<double>(leaf_vertices) / seconds : 0;
  const std::string text =
      pace < 1e6 ? count(static_cast<std::uint64_t>(pace)) : number(pace / 1e6, 3) + " M";
  return text + " leaf vertices/s";
}

std::string counted(std::uint64_t things, const std::string& name) {
  return count(things) + " " + name + (things == 1 ? "" : "s");
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
