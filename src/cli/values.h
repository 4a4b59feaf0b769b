// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>

#include "leafhull/options.h"

namespace leafhull::cli {

/// Reads `text` into the member of `row`. Ranges are resolve's business.
/// @throws Error usage: not a number, or not one of the names.
void set_option(Options& options, const OptionRow& row, const std::string& text);

/// @throws Error usage: `text` is no whole number from `low` to `high`.
int whole_number(std::string_view flag, const std::string& text, int low, int high);

/// @throws Error usage: `text` is no number from `low` to `high`.
double real_number(std::string_view flag, const std::string& text, double low, double high);

/// Bytes: 4G, 512M, 1.5g or a plain number; K, M, G and T count in powers of 1024.
/// @throws Error usage: not such a size, or below `low`.
std::uint64_t byte_count(std::string_view flag, const std::string& text, std::uint64_t low);

/// The index of `text` among `valid`.
/// @throws Error usage: it is none of them; the nearest is suggested.
std::size_t choice(std::string_view flag, std::string_view text,
                   std::span<const std::string_view> valid);

/// The value of an enumeration that `text` names.
/// @throws Error usage: it names none; the nearest is suggested.
template <class Enum>
Enum chosen(std::string_view flag, const std::string& text) {
  return static_cast<Enum>(choice(flag, text, names(Enum{})));
}

/// The one of `valid` that `text` was probably meant to be; empty where none is near.
std::string_view nearest(std::string_view text, std::span<const std::string_view> valid);

std::string joined(std::span<const std::string_view> words, std::string_view separator);

/// Quoted for a POSIX shell where it has to be.
std::string quoted(const std::string& word);

std::string number(double value, int digits = 6);  ///< at most so many significant digits
std::string count(std::uint64_t value);            ///< 1,234,567
std::string seconds(double value);                 ///< 0.123 s
std::string bytes(std::uint64_t value);            ///< 512 MiB, 1.5 GiB

}  // namespace leafhull::cli
