// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>

namespace leafhull {

// New names for d and Tr in a material library, as tinyobjloader would read only one of the two.
inline constexpr const char* kDissolve = "dissolve";
inline constexpr const char* kTransparency = "transparency";

/// The text of an OBJ file or a material library as its readers take it: without a byte order mark,
/// its lines ended by LF, those joined that a backslash continues, and known keywords in the
/// capitals that tinyobjloader asks for. Every line keeps its number.
std::string obj_text(std::string_view written);

/// Removes the text up to the next LF from the front, and returns it without the LF.
std::string_view take_line(std::string_view& text);

/// Removes the next word from the front of a line and returns it; empty at the end.
std::string_view take_word(std::string_view& line);

/// The text without blanks at its ends.
std::string_view trimmed(std::string_view text);

/// The number that a word holds; NaN if it is not a finite number.
double finite_number(std::string_view word);

}  // namespace leafhull
