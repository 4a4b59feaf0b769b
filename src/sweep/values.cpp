// SPDX-License-Identifier: Apache-2.0
// The values that the text of a swept option stands for.
#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <optional>
#include <set>
#include <type_traits>
#include <utility>

#include "leafhull/error.h"
#include "sweep/sweep_plan.h"
#include "text/choice.h"
#include "text/numbers.h"

namespace leafhull {
namespace {

constexpr double kMostCombinations = 100'000;
/// The last value of a range may miss its end by this fraction of a step.
constexpr double kSlack = 1e-9;
/// Significant digits kept of a range's largest number; rounding errors lie below them.
constexpr int kDigits = 14;

enum class Kind { fixed, number, name };

Kind kind_of(bool) { return Kind::fixed; }
Kind kind_of(int) { return Kind::number; }
Kind kind_of(double) { return Kind::number; }
Kind kind_of(const std::vector<std::string>&) { return Kind::fixed; }
Kind kind_of(const TextureEllipse&) { return Kind::fixed; }
Kind kind_of(const LeafColour&) { return Kind::fixed; }
Kind kind_of(const Srgb&) { return Kind::fixed; }

template <class Enum>
requires std::is_enum_v<Enum> Kind kind_of(Enum) { return Kind::name; }

template <class Value>
Kind kind_of(const std::optional<Value>&) {
  return kind_of(Value{});
}

Kind kind_of(const OptionRow& row) {
  return std::visit([](auto member) { return kind_of(Options{}.*member); }, row.member);
}

[[noreturn]] void refuse(const OptionRow& row, std::string_view text, const std::string& why,
                         std::string remedy) {
  throw Error(ErrorCode::usage,
              "--" + std::string(row.name) + " '" + std::string(text) + "' " + why,
              std::move(remedy));
}

std::vector<std::string_view> split(std::string_view text, char separator) {
  std::vector<std::string_view> parts;
  std::size_t end = text.find(separator);
  for (; end != std::string_view::npos; end = text.find(separator)) {
    parts.push_back(text.substr(0, end));
    text.remove_prefix(end + 1);
  }
  parts.push_back(text);
  return parts;
}

double number(const OptionRow& row, std::string_view text, std::string_view part) {
  const std::optional<double> value = parsed<double>(part);
  if (!value || !std::isfinite(*value)) {
    refuse(row, text, "is neither a range nor a list of numbers",
           "Give first:last:step such as 1.5:2.5:0.25, or a list such as 1.5,2,2.5.");
  }
  return *value;
}

/// The fewest digits that give the same number back, without an exponent where people write none.
std::string written(double value) {
  const double size = std::abs(value);
  if (size != 0 && (size < 1e-6 || size >= 1e15)) return shortest(value);
  std::array<char, 32> text;
  return {
      text.data(),
      std::to_chars(text.data(), text.data() + text.size(), value, std::chars_format::fixed).ptr};
}

/// `value` without the digits of binary rounding, in a range that reaches to `scale`.
double clean(double value, double scale) {
  const int decimals = std::max(0, kDigits - 1 - static_cast<int>(std::floor(std::log10(scale))));
  return parsed<double>(fixed(value, decimals)).value_or(value) + 0.0;  // no -0
}

std::vector<std::string> range(const OptionRow& row, std::string_view text,
                               const std::vector<double>& parts) {
  if (parts.size() != 3) {
    refuse(row, text, "is not a range", "Give first:last:step such as 1.5:2.5:0.25.");
  }
  const double first = parts[0], last = parts[1], step = parts[2];
  if (step <= 0) refuse(row, text, "has a step that is not above zero", "Give one such as 0.25.");
  if (first > last) {
    refuse(row, text, "runs backwards",
           "Put the lower end first: " + written(last) + ":" + written(first) + ":" +
               written(step) + ".");
  }
  const double steps = std::floor((last - first) / step + kSlack);
  if (!(steps < kMostCombinations)) {
    refuse(row, text, "has " + written(steps + 1) + " values, more than a sweep can hold",
           "Take a larger step.");
  }
  const double scale = std::max({std::abs(first), std::abs(last), step});
  std::vector<std::string> values;
  for (int i = 0; i <= steps; ++i) values.push_back(written(clean(first + i * step, scale)));
  return values;
}

void refuse_twice(const OptionRow& row, std::string_view text,
                  const std::vector<std::string>& values) {
  std::set<std::string_view> seen;
  for (const std::string& value : values) {
    if (!seen.insert(value).second) {
      refuse(row, text, "holds " + value + " twice", "Give each value once.");
    }
  }
}

/// Removes the % from every number. @return whether they had one.
bool take_percent(const OptionRow& row, std::string_view text,
                  std::vector<std::string_view>& parts) {
  const auto has_percent = [](std::string_view part) { return part.ends_with('%'); };
  const auto count = std::count_if(parts.begin(), parts.end(), has_percent);
  if (!takes_percent(row) || count == 0) return false;
  if (count != std::ssize(parts)) {
    refuse(row, text, "mixes plain numbers and percentages",
           "Write % after every number or none, such as 30%:60%:10%.");
  }
  for (std::string_view& part : parts) part.remove_suffix(1);
  return true;
}

/// The numbers of a list, or of a range from its three parts.
SweptOption swept_numbers(const OptionRow& row, std::string_view text,
                          std::vector<std::string_view> parts, bool is_range) {
  const bool percent = take_percent(row, text, parts);
  std::vector<double> numbers;
  for (const std::string_view part : parts) numbers.push_back(number(row, text, part));
  const bool fraction = percent && row.percent.empty();
  if (fraction) {
    for (double& n : numbers) n /= 100;
  }
  std::vector<std::string> values;
  if (is_range) {
    values = range(row, text, numbers);
  } else {
    std::transform(numbers.begin(), numbers.end(), std::back_inserter(values), written);
  }
  refuse_twice(row, text, values);
  return {percent && !fraction ? &option_row(row.percent) : &row, values};
}

/// Reads a number or a name; other members cannot be swept.
template <class Value>
void set_member(Value& value, const OptionRow& row, const std::string& text) {
  if constexpr (std::is_same_v<Value, double> || std::is_same_v<Value, int>) {
    const std::optional<Value> read = parsed<Value>(text);
    const bool whole = std::is_same_v<Value, int>;
    if (!read) {
      refuse(row, text, whole ? "is not a whole number" : "is not a number",
             whole ? "Give a number such as 2." : "Give a number such as 1.5.");
    }
    value = *read;
  } else if constexpr (std::is_same_v<Value, Style>) {
    value = style_named(text);
  } else if constexpr (std::is_enum_v<Value>) {
    value = static_cast<Value>(choice("--" + std::string(row.name), text, names(value)));
  } else {
    refuse(row, text, "cannot be swept", "Give it one value.");
  }
}

template <class Value>
void set_member(std::optional<Value>& value, const OptionRow& row, const std::string& text) {
  set_member(value.emplace(), row, text);
}

}  // namespace

bool takes_number(const OptionRow& row) { return kind_of(row) == Kind::number; }

bool can_sweep(const OptionRow& row) {
  return (row.group == "Shape" || row.group == "Resolution") && kind_of(row) != Kind::fixed;
}

SweptOption swept_option(const OptionRow& row, std::string_view text) {
  const bool is_number = takes_number(row);
  const bool is_range = is_number && text.find(':') != std::string_view::npos;
  const bool is_list = !is_range && text.find(',') != std::string_view::npos;
  if (!can_sweep(row) || (!is_range && !is_list)) return {&row, {std::string(text)}};

  std::vector<std::string_view> parts = split(text, is_range ? ':' : ',');
  if (!is_number) {
    const std::vector<std::string> names(parts.begin(), parts.end());
    if (std::find(names.begin(), names.end(), "") != names.end()) {
      refuse(row, text, "holds an empty name", "Give names between the commas.");
    }
    refuse_twice(row, text, names);
    return {&row, names};
  }
  return swept_numbers(row, text, std::move(parts), is_range);
}

SweptOption swept_number(const OptionRow& row, const std::string& text) {
  return swept_numbers(row, text, {text}, false);
}

void set_swept(Options& options, const OptionRow& row, const std::string& text) {
  std::visit([&](auto member) { set_member(options.*member, row, text); }, row.member);
}

std::size_t combination_count(std::span<const SweptOption> swept) {
  double count = 1;
  for (const SweptOption& option : swept) count *= static_cast<double>(option.values.size());
  if (count > kMostCombinations) {
    throw Error(ErrorCode::usage,
                "these are " + written(count) + " combinations, more than a sweep can hold",
                "Take larger steps, or sweep fewer options at once.");
  }
  return static_cast<std::size_t>(count);
}

}  // namespace leafhull
