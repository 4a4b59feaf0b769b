// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <type_traits>
#include <utility>
#include <variant>
#include <vector>

#include "leafhull/forest.h"
#include "leafhull/options.h"
#include "leafhull/render.h"
#include "text/choice.h"
#include "text/numbers.h"

namespace leafhull::cli {

/// What was typed as the value of an option.
struct Typed {
  const OptionLine& line;
  const std::string& text;
  std::string flag = "--" + std::string(line.name);
  bool in_range = true;  ///< numbers are checked against the line's range; false: by resolve()
};

// Each reads a value. @throws Error usage: the text is not a value, or is out of range.

void parse(bool& value, const Typed& typed);  ///< flips it
void parse(int& value, const Typed& typed);
void parse(double& value, const Typed& typed);
void parse(std::uint64_t& value, const Typed& typed);
/// 4G, 512M, 1.5g or a plain number; K, M, G and T count in powers of 1024.
void parse(ByteCount& value, const Typed& typed);
void parse(std::string& value, const Typed& typed);
void parse(std::filesystem::path& value, const Typed& typed);
void parse(Vec2d& value, const Typed& typed);
void parse(Srgb& value, const Typed& typed);
void parse(LeafColour& value, const Typed& typed);
void parse(TextureEllipse& value, const Typed& typed);
void parse(TileRange& value, const Typed& typed);
void parse(Style& value, const Typed& typed);
void parse(Plate& value, const Typed& typed);

template <class Enum>
requires std::is_enum_v<Enum>
void parse(Enum& value, const Typed& typed) {
  value = static_cast<Enum>(choice(typed.flag, typed.text, names(value)));
}

template <class Value>
void parse(std::vector<Value>& value, const Typed& typed) {
  parse(value.emplace_back(), typed);
}

template <class Value>
void parse(std::optional<Value>& value, const Typed& typed) {
  parse(value.emplace(), typed);
}

/// The sides of a picture.
void parse(int& width, int& height, const Typed& typed);
/// The ends of a range.
void parse(double& low, double& high, const Typed& typed);

template <class Struct, class Value>
void assign(Struct& options, Value Struct::*part, const Typed& typed) {
  parse(options.*part, typed);
}

template <class Struct, class Value>
void assign(Struct& options, std::pair<Value Struct::*, Value Struct::*> parts,
            const Typed& typed) {
  parse(options.*parts.first, options.*parts.second, typed);
}

template <class Struct, class Inner, class Value>
void assign(Struct& options, std::pair<std::optional<Inner> Struct::*, Value Inner::*> path,
            const Typed& typed) {
  std::optional<Inner>& inner = options.*path.first;
  if (!inner) inner.emplace();
  parse(*inner.*path.second, typed);
}

/// Reads a value into the row's member. @throws Error usage, as parse().
template <class Struct, class... Members>
void set_value(Struct& options, const RowOf<Struct, Members...>& row, const Typed& typed) {
  std::visit([&](auto part) { assign(options, part, typed); }, row.member);
}

/// Reads `text` into the row's member, or a percentage into the option that takes it. resolve()
/// checks ranges.
/// @throws Error usage: not a number, or not one of the names.
void set_option(Options& options, const OptionRow& row, const std::string& text);

/// Quoted for a POSIX shell where it has to be.
std::string quoted(const std::string& word);

/// With at most `digits` significant digits.
inline std::string number(double value, int digits = 6) { return significant(value, digits); }
inline std::string count(std::uint64_t value) { return grouped(value); }
std::string seconds(double value);       ///< 0.123 s
std::string bytes(std::uint64_t value);  ///< 512 MiB, 1.5 GiB
/// "1 tree", "2 trees"
std::string counted(std::uint64_t things, const std::string& name);

}  // namespace leafhull::cli
