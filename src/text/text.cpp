// SPDX-License-Identifier: Apache-2.0
#include "text/text.h"

#include <array>
#include <cstdint>

namespace leafhull {
namespace {

constexpr char32_t kReplacement = 0xFFFD;

/// Takes the first character off `text` and returns it.
char32_t take_character(std::string_view& text) {
  const auto byte = [&](std::size_t i) { return static_cast<std::uint8_t>(text[i]); };
  const std::uint8_t first = byte(0);
  const std::size_t length = first < 0x80   ? 1
                             : first < 0xC2 ? 0
                             : first < 0xE0 ? 2
                             : first < 0xF0 ? 3
                             : first < 0xF5 ? 4
                                            : 0;
  char32_t character = length == 1 ? first : first & (0x7F >> length);
  bool valid = length > 0 && length <= text.size();
  for (std::size_t i = 1; valid && i < length; ++i) {
    valid = (byte(i) & 0xC0) == 0x80;
    character = character << 6 | (byte(i) & 0x3F);
  }
  constexpr std::array<char32_t, 5> kLeast{0, 0, 0x80, 0x800, 0x10000};
  valid = valid && character >= kLeast[length] && character <= 0x10FFFF &&
          (character < 0xD800 || character > 0xDFFF);
  text.remove_prefix(valid ? length : 1);
  return valid ? character : kReplacement;
}

bool is_word(char32_t c) {
  return (c >= '0' && c <= '9') || (c >= 'A' && c <= 'Z') || (c >= 'a' && c <= 'z') || c >= 0x80;
}

}  // namespace

std::u32string decode_utf8(std::string_view text) {
  std::u32string characters;
  while (!text.empty()) {
    const char32_t c = take_character(text);
    const bool control = c < 0x20 || (c >= 0x7F && c < 0xA0) || c == 0xFFFE || c == 0xFFFF;
    characters += control ? U' ' : c;
  }
  return characters;
}

void append_utf8(char32_t character, std::string& text) {
  const auto add = [&](char32_t byte) { text += static_cast<char>(byte); };
  if (character < 0x80) return add(character);
  if (character >= 0x10000) {
    add(0xF0 | character >> 18), add(0x80 | (character >> 12 & 0x3F));
  } else if (character >= 0x800) {
    add(0xE0 | character >> 12);
  } else {
    add(0xC0 | character >> 6);
  }
  if (character >= 0x800) add(0x80 | (character >> 6 & 0x3F));
  add(0x80 | (character & 0x3F));
}

std::string in_lower_case(std::string text) {
  for (char& c : text) {
    if (c >= 'A' && c <= 'Z') c += 'a' - 'A';
  }
  return text;
}

std::string printable(std::string_view text, std::size_t longest) {
  const bool cut = text.size() > longest;
  std::string line(text.substr(0, longest));
  for (char& c : line) {
    if (static_cast<unsigned char>(c) < 0x20 || c == 0x7F) c = ' ';
  }
  return cut ? line + "..." : line;
}

std::vector<TextRun> split_subscripts(std::string_view label) {
  const std::u32string text = decode_utf8(label);
  std::vector<TextRun> runs{{}};
  for (std::size_t i = 0; i < text.size(); ++i) {
    const bool letter_before = i > 0 && is_word(text[i - 1]) && (i < 2 || !is_word(text[i - 2]));
    const bool word_after = i + 1 < text.size() && is_word(text[i + 1]);
    if (text[i] == '_' && !runs.back().subscript && letter_before && word_after) {
      runs.push_back({{}, true});
      continue;
    }
    if (runs.back().subscript && !is_word(text[i])) runs.push_back({});
    runs.back().text += text[i];
  }
  return runs;
}

}  // namespace leafhull
