// SPDX-License-Identifier: Apache-2.0
#include "leafhull/option_row.h"

#include <array>
#include <charconv>
#include <cmath>

#include "leafhull/error.h"
#include "options/messages.h"

namespace leafhull {
namespace {

/// So many whole numbers are told one by one.
constexpr double kListed = 3;

std::string text(double value) { return number_text(value); }
std::string text(int value) { return std::to_string(value); }
std::string text(std::uint64_t value) { return std::to_string(value); }

/// As --memory takes it.
std::string text(ByteCount value) {
  constexpr std::string_view kUnits = " KMGT";
  std::uint64_t size = value;
  std::size_t unit = 0;
  for (; unit + 1 < kUnits.size() && size > 0 && size % 1024 == 0; ++unit) size /= 1024;
  return std::to_string(size) + (unit > 0 ? std::string(1, kUnits[unit]) : "");
}

/// The numbers as the help has them, the ends as values of type `Number`.
template <class Number>
std::string range_text(const Interval& numbers) {
  const bool is_whole = !std::is_same_v<Number, double>;
  const auto end = [](double value) { return text(static_cast<Number>(value)); };
  const bool bounded_below = numbers.low > -kLargestNumber;
  const bool bounded_above = numbers.high < kLargestNumber;
  if (!bounded_above) {
    if (!bounded_below) return "any number";
    return (numbers.low_open ? "> " : ">= ") + end(numbers.low);
  }
  if (numbers.step > 1) {
    return end(numbers.low) + " to " + end(numbers.high) + ", a multiple of " + text(numbers.step);
  }
  if (is_whole && numbers.high - numbers.low < kListed) {
    std::string list = end(numbers.low);
    for (double n = numbers.low + 1; n <= numbers.high; ++n) list += ", " + end(n);
    return list;
  }
  return (numbers.low_open ? "(" : "[") + end(numbers.low) + ", " + end(numbers.high) +
         (numbers.high_open ? ")" : "]");
}

void fill(std::string& text, std::string_view otherwise) {
  if (text.empty()) text = otherwise;
}

template <class Number>
void describe_number(OptionLine& line, std::string_view word, Number value) {
  fill(line.value, word);
  if (line.range.empty()) line.range = range_text<Number>(line);
  fill(line.default_value, text(value));
}

std::string flag(const OptionLine& line) { return "--" + std::string(line.name); }

template <class Number>
void check_number(const OptionLine& line, Number value) {
  const auto number = static_cast<double>(value);
  const bool inside = std::isfinite(number) &&
                      (line.high_open ? number < line.high : number <= line.high) &&
                      (line.low_open ? number > line.low : number >= line.low);
  const std::string what = flag(line) + " " + text(value);
  if (!std::isfinite(number))
    refuse_option(what + " is not a finite number", "Give a plain number.");
  if (!inside) refuse_option(what + " is out of range", "Its range is " + line.range + ".");
}

}  // namespace

std::string number_text(double value) {
  std::array<char, 32> buffer;
  const auto end = std::to_chars(buffer.data(), buffer.data() + buffer.size(), value).ptr;
  return {buffer.data(), end};
}

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

void describe(OptionLine& line, int value) { describe_number(line, "N", value); }
void describe(OptionLine& line, double value) { describe_number(line, "X", value); }
void describe(OptionLine& line, std::uint64_t value) { describe_number(line, "N", value); }
void describe(OptionLine& line, ByteCount value) { describe_number(line, "SIZE", value); }

void describe_names(OptionLine& line, std::span<const std::string_view> names, std::size_t value) {
  line.choices = names;
  describe(line, std::string(names[value]));
}

void describe(OptionLine& line, const std::string& value) {
  fill(line.value, "NAME");
  if (line.range.empty()) {
    for (const std::string_view choice : line.choices) {
      line.range.append(line.range.empty() ? "" : ", ").append(choice);
    }
  }
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

void check_value(const OptionLine& line, double value) { check_number(line, value); }

void check_value(const OptionLine& line, int value) {
  check_number(line, value);
  if (value % line.step == 0) return;
  const int below = value - value % line.step;
  refuse_option(flag(line) + " " + text(value) + " is no multiple of " + text(line.step),
                "Give " + text(below) + " or " + text(below + line.step) + ".");
}

void check_value(const OptionLine& line, std::uint64_t value) { check_number(line, value); }
void check_value(const OptionLine& line, ByteCount value) { check_number(line, value); }

void check_value(const OptionLine& line, const std::vector<std::string>& value) {
  for (const std::string& glob : value) {
    if (glob.empty()) {
      refuse_option(flag(line) + " is empty", "Give a name or a pattern such as '*leaf*'.");
    }
  }
}

void check_name(const OptionLine& line, std::size_t value) {
  if (value < line.choices.size()) return;
  refuse_option(flag(line) + " holds no value of its kind", "Give one of " + line.range + ".");
}

}  // namespace leafhull
