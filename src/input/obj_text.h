// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>

namespace leafhull {

// Of a material library, where tinyobjloader would read only one of them: other keywords to it.
inline constexpr const char* kDissolve = "dissolve";
inline constexpr const char* kTransparency = "transparency";

/// The text of an OBJ file or a material library as its readers take it: without a byte order mark,
/// its lines ended by LF, those joined that a backslash continues, and known keywords in the
/// capitals that tinyobjloader asks for. Every line keeps its number.
std::string obj_text(std::string_view written);

/// The text up to the next LF, taken from its front with that.
std::string_view take_line(std::string_view& text);

/// The next word of a line, taken from its front; empty at its end.
std::string_view take_word(std::string_view& line);

/// Without blanks at its ends.
std::string_view trimmed(std::string_view text);

/// NaN where a word is not a finite number.
double finite_number(std::string_view word);

}  // namespace leafhull
