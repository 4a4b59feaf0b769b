// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace leafhull {

/// A part of a label, on the baseline or below it as a subscript.
struct TextRun {
  std::u32string text;
  bool subscript = false;
};

/// Characters that can be drawn: what is not UTF-8 becomes U+FFFD, a control character a space.
std::u32string decode_utf8(std::string_view text);

void append_utf8(char32_t character, std::string& text);

/// The text with a to z in place of A to Z; other letters stay.
std::string in_lower_case(std::string text);

/// Text from a file made fit for a one-line message: control characters replaced, long text cut.
std::string printable(std::string_view text, std::size_t longest = 80);

/// The parts of a label. An underscore after a word of one letter makes the rest of the word its
/// subscript: R_max, but not birch_2.
std::vector<TextRun> split_subscripts(std::string_view label);

}  // namespace leafhull
