// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <limits>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>
#include <variant>
#include <vector>

#include "leafhull/api.h"
#include "leafhull/vec.h"

// A row says everything about one option: the member of the struct that holds it, its numbers and
// its words. Flags, help, checks, reports, the tables of the documentation, the manual and shell
// completion follow from rows.

namespace leafhull {

/// A size in memory.
struct ByteCount {
  std::uint64_t bytes = 0;
};

/// The largest number of an option that has no bound of its own: the density kernels take floats.
inline constexpr double kLargestNumber = std::numeric_limits<float>::max();

/// The numbers that an option allows.
struct Interval {
  double low = 0, high = 0;
  bool low_open = false;   ///< the lower bound itself is excluded
  bool high_open = false;  ///< the upper bound itself is excluded
  int step = 1;            ///< whole numbers are multiples of it
};
inline constexpr Interval kPositive{.high = kLargestNumber, .low_open = true};
inline constexpr Interval kAnyNumber{-kLargestNumber, kLargestNumber};

/// What a row says beyond its name and its help. What is empty follows from the member.
struct OptionFacts {
  std::string_view unit = "";
  std::string_view range = "";          ///< in words, where numbers or names do not tell it
  std::string_view default_value = "";  ///< in words, e.g. "by style"
  /// The option that takes X where this one is given as X%; empty where % says nothing.
  std::string_view percent = "";
  std::string_view value = "";  ///< what the help calls the value, e.g. "FILE"
  std::string_view word = "";   ///< what may follow a flag that takes no other value
  char letter = 0;              ///< the short flag's
  std::span<const std::string_view> choices = {};  ///< the values that a text may have
};

/// An option as its users see it.
struct OptionLine : Interval {
  LEAFHULL_API OptionLine(std::string_view group, std::string_view name, const Interval& numbers,
                          std::string_view help, const OptionFacts& facts);

  /// The name, as in the flag --name and, with underscores, in the report.
  std::string_view name;
  std::string spelling;       ///< "-o,--output"; --no-snap of `snap`, which is on without it
  std::string value;          ///< what the help calls the value; empty: the flag takes none
  std::string_view word;      ///< what may follow a flag that takes no other value
  std::string_view group;     ///< "Leaves", "Shape", "Resolution", ...
  std::string_view unit;      ///< "" where it has none
  std::string range;          ///< in words or as an interval, e.g. "(0, 1]"
  std::string default_value;  ///< in words, e.g. "by style"
  std::string_view help;
  std::string_view percent;                   ///< as in OptionFacts
  std::span<const std::string_view> choices;  ///< the names that its values have, if any
  bool repeatable = false;
};

/// Whether the row takes `X%`: as X for another option, or as the fraction X / 100.
inline bool takes_percent(const OptionLine& line) {
  return !line.percent.empty() || line.unit == "fraction";
}

// describe() completes a line from the value's type and its default in a new struct. check_value()
// throws Error usage where a value is outside the line's range. A type that a row holds has both,
// beside its declaration.

LEAFHULL_API void describe(OptionLine& line, bool value);
LEAFHULL_API void describe(OptionLine& line, int value);
LEAFHULL_API void describe(OptionLine& line, double value);
LEAFHULL_API void describe(OptionLine& line, std::uint64_t value);
LEAFHULL_API void describe(OptionLine& line, ByteCount value);
LEAFHULL_API void describe(OptionLine& line, const std::string& value);
LEAFHULL_API void describe(OptionLine& line, const std::vector<std::string>& value);
LEAFHULL_API void describe(OptionLine& line, const std::filesystem::path& value);
LEAFHULL_API void describe(OptionLine& line, const std::vector<std::filesystem::path>& value);
LEAFHULL_API void describe(OptionLine& line, const Vec2d& value);
LEAFHULL_API void describe_names(OptionLine& line, std::span<const std::string_view> names,
                                 std::size_t value);

template <class Enum>
requires std::is_enum_v<Enum>
void describe(OptionLine& line, Enum value) {
  describe_names(line, names(value), static_cast<std::size_t>(value));
}

/// An option that is empty by default has a default in words, or none.
template <class Value>
void describe(OptionLine& line, const std::optional<Value>&) {
  if (line.default_value.empty()) line.default_value = "none";
  describe(line, Value{});
}

LEAFHULL_API void check_value(const OptionLine& line, double value);
LEAFHULL_API void check_value(const OptionLine& line, int value);
LEAFHULL_API void check_value(const OptionLine& line, std::uint64_t value);
LEAFHULL_API void check_value(const OptionLine& line, ByteCount value);
LEAFHULL_API void check_value(const OptionLine& line, const std::vector<std::string>& value);
LEAFHULL_API void check_name(const OptionLine& line, std::size_t value);
inline void check_value(const OptionLine&, bool) {}
inline void check_value(const OptionLine&, const std::string&) {}
inline void check_value(const OptionLine&, const std::filesystem::path&) {}
inline void check_value(const OptionLine&, const std::vector<std::filesystem::path>&) {}
inline void check_value(const OptionLine&, const Vec2d&) {}

template <class Enum>
requires std::is_enum_v<Enum>
void check_value(const OptionLine& line, Enum value) {
  check_name(line, static_cast<std::size_t>(value));
}

template <class Value>
void check_value(const OptionLine& line, const std::optional<Value>& value) {
  if (value) check_value(line, *value);
}

/// A row of the options that `Struct` holds. Each of `Members` is a pointer to a member, or a way
/// to a value that is no single member; the row's facts then say everything, and the struct's owner
/// checks the value.
template <class Struct, class... Members>
struct RowOf : OptionLine {
  using Member = std::variant<Members...>;

  RowOf(std::string_view group, std::string_view name, Member at, const Interval& numbers,
        std::string_view help, const OptionFacts& facts = {})
      : OptionLine(group, name, numbers, help, facts), member(at) {
    const Struct by_default;
    std::visit(
        [&](auto part) {
          if constexpr (std::is_member_pointer_v<decltype(part)>) describe(*this, by_default.*part);
        },
        member);
  }
  RowOf(std::string_view group, std::string_view name, Member at, std::string_view help,
        const OptionFacts& facts = {})
      : RowOf(group, name, at, Interval{}, help, facts) {}

  Member member;
};

/// A row of options that are members with these types.
template <class Struct, class... Values>
using RowOver = RowOf<Struct, Values Struct::*...>;

/// Checks every member against its row.
/// @throws Error usage: one is out of range.
template <class Struct, class... Members>
void check_rows(std::span<const RowOf<Struct, Members...>> rows, const Struct& options) {
  for (const auto& row : rows) {
    std::visit(
        [&](auto part) {
          if constexpr (std::is_member_pointer_v<decltype(part)>) check_value(row, options.*part);
        },
        row.member);
  }
}

}  // namespace leafhull
