// SPDX-License-Identifier: Apache-2.0
#include "leafhull/option_row.h"

#include <cmath>

#include "leafhull/error.h"
#include "options/messages.h"
#include "text/choice.h"
#include "text/numbers.h"

namespace leafhull {
namespace {

/// Up to this many whole numbers are listed one by one.
constexpr int kListed = 3;

/// How numbers of one kind are written.
using Writer = std::string (*)(double);

std::string whole_text(double value) { return std::to_string(std::llround(value)); }

/// A size as --memory takes it.
std::string size_text(double value) {
  constexpr std::string_view kUnits = " KMGT";
  auto size = std::llround(value);
  std::size_t unit = 0;
  for (; unit + 1 < kUnits.size() && size > 0 && size % 1024 == 0; ++unit) size /= 1024;
  return std::to_string(size) + (unit > 0 ? std::string(1, kUnits[unit]) : "");
}

/// The numbers as the help has them.
std::string range_text(const Interval& numbers, Writer text) {
  const auto& [low, high, low_open, high_open, step] = numbers;
  if (high >= kLargestNumber) {
    if (low <= -kLargestNumber) return "any number";
    return (low_open ? "> " : ">= ") + text(low);
  }
  if (step > 1) return text(low) + " to " + text(high) + ", a multiple of " + text(step);
  if (text == whole_text && high - low < kListed) {
    std::string list = text(low);
    for (int above = 1; above <= high - low; ++above) list.append(", ").append(text(low + above));
    return list;
  }
  return (low_open ? "(" : "[") + text(low) + ", " + text(high) + (high_open ? ")" : "]");
}

void fill(std::string& text, std::string_view otherwise) {
  if (text.empty()) text = otherwise;
}

void describe_number(OptionLine& line, std::string_view word, double value, Writer text) {
  fill(line.value, word);
  if (line.range.empty()) line.range = range_text(line, text);
  fill(line.default_value, text(value));
}

std::string flag(const OptionLine& line) { return "--" + std::string(line.name); }

void check_number(const OptionLine& line, double value, Writer text) {
  const bool inside = std::isfinite(value) &&
                      (line.high_open ? value < line.high : value <= line.high) &&
                      (line.low_open ? value > line.low : value >= line.low);
  if (inside) return;
  if (!std::isfinite(value)) {
    refuse_option(flag(line) + " " + text(value) + " is not a finite number",
                  "Give a plain number.");
  }
  refuse_option(flag(line) + " " + text(value) + " is out of range",
                "Its range is " + line.range + ".");
}

}  // namespace

void refuse_option(const std::string& message, const std::string& remedy) {
  throw Error(ErrorCode::usage, message, remedy);
}

OptionLine::OptionLine(std::string_view of, std::string_view called, const Interval& numbers,
                       std::string_view meaning, const OptionFacts& facts)
    : Interval(numbers),
      name(called),
      spelling((facts.letter != 0 ? std::string{'-', facts.letter, ','} : "") + "--" +
               std::string(called)),
      value(facts.value),
      word(facts.word),
      group(of),
      unit(facts.unit),
      range(facts.range),
      default_value(facts.default_value),
      help(meaning),
      percent(facts.percent),
      choices(facts.choices) {}

void describe(OptionLine& line, bool value) {
  if (value) line.spelling = "--no-" + std::string(line.name);
  fill(line.default_value, "off");
}

void describe(OptionLine& line, int value) { describe_number(line, "N", value, whole_text); }

void describe(OptionLine& line, double value) { describe_number(line, "X", value, shortest); }

void describe(OptionLine& line, std::uint64_t value) {
  describe_number(line, "N", static_cast<double>(value), whole_text);
}

void describe(OptionLine& line, ByteCount value) {
  describe_number(line, "SIZE", static_cast<double>(value.bytes), size_text);
}

void describe_names(OptionLine& line, std::span<const std::string_view> names, std::size_t value) {
  line.choices = names;
  describe(line, std::string(names[value]));
}

void describe(OptionLine& line, const std::string& value) {
  fill(line.value, "NAME");
  if (line.range.empty()) line.range = joined(line.choices, ", ");
  fill(line.default_value, value);
}

void describe(OptionLine& line, const std::vector<std::string>&) {
  fill(line.value, "GLOB");
  fill(line.default_value, "none");
  line.repeatable = true;
}

void describe(OptionLine& line, const std::filesystem::path&) {
  fill(line.value, "FILE");
  fill(line.default_value, "none");
}

void describe(OptionLine& line, const std::vector<std::filesystem::path>&) {
  describe(line, std::filesystem::path());
  line.repeatable = true;
}

void describe(OptionLine& line, const Vec2d&) { fill(line.value, "WxD"); }

void check_value(const OptionLine& line, double value) { check_number(line, value, shortest); }

void check_value(const OptionLine& line, int value) {
  check_number(line, value, whole_text);
  if (value % line.step == 0) return;
  const int below = value - value % line.step;
  refuse_option(flag(line) + " " + std::to_string(value) + " is not a multiple of " +
                    std::to_string(line.step),
                "Give " + std::to_string(below) + " or " + std::to_string(below + line.step) + ".");
}

void check_value(const OptionLine& line, std::uint64_t value) {
  check_number(line, static_cast<double>(value), whole_text);
}

void check_value(const OptionLine& line, ByteCount value) {
  check_number(line, static_cast<double>(value.bytes), size_text);
}

void check_value(const OptionLine& line, const std::vector<std::string>& value) {
  for (const std::string& glob : value) {
    if (glob.empty()) {
      refuse_option(flag(line) + " is empty", "Give a name or a pattern such as '*leaf*'.");
    }
  }
}

void check_name(const OptionLine& line, std::size_t value) {
  if (value < line.choices.size()) return;
  refuse_option(flag(line) + " has an unknown value", "Give one of " + line.range + ".");
}

}  // namespace leafhull
