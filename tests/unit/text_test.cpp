// SPDX-License-Identifier: Apache-2.0
#include "text/text.h"

#include <gtest/gtest.h>

#include "text/file_name.h"

namespace leafhull {
namespace {

std::string marked(std::string_view label) {
  std::string text;
  for (const TextRun& run : split_subscripts(label)) {
    text += run.subscript ? "[" : "";
    for (const char32_t c : run.text) append_utf8(c, text);
    text += run.subscript ? "]" : "";
  }
  return text;
}

TEST(Text, DecodesEveryLength) {
  EXPECT_EQ(decode_utf8("aλ€🌳"), U"aλ€🌳");
  EXPECT_EQ(decode_utf8(""), U"");
}

TEST(Text, OfAFileFitsALine) {
  EXPECT_EQ(printable("a\nb\x1B\x7F\tλ"), "a b   λ");
  EXPECT_EQ(printable("abc", 3), "abc");
  EXPECT_EQ(printable("abcd", 3), "abc...");
}

TEST(FileNames, HaveExtensionsInAnyCase) {
  EXPECT_EQ(lower_extension("a.d/FILE.tar.PNG"), ".png");
  EXPECT_EQ(lower_extension("a.d/file"), "");
}

TEST(FileNames, LookLikeFiles) {
  for (const char* file : {"a.json", "a/b", "./a", "/"}) EXPECT_TRUE(looks_like_file(file)) << file;
  for (const char* name : {"clasic", ""}) EXPECT_FALSE(looks_like_file(name)) << name;
}

TEST(Text, EncodesWhatItDecodes) {
  for (const std::string_view text : {"a\x7F", "λ\u07FF", "\u0800€\uFFFD", "🌳\U0010FFFF"}) {
    std::string again;
    for (const char32_t c : decode_utf8(text)) append_utf8(c, again);
    EXPECT_EQ(again, text == "a\x7F" ? "a " : text);
  }
}

TEST(Text, ReplacesBytesThatAreNotUtf8) {
  EXPECT_EQ(decode_utf8("a\xFF"
                        "b"),
            U"a\uFFFDb");
  EXPECT_EQ(decode_utf8("\xCE"), U"\uFFFD");                      // cut short
  EXPECT_EQ(decode_utf8("\xCEz"), U"\uFFFDz");                    // not continued
  EXPECT_EQ(decode_utf8("\xC0\xAF"), U"\uFFFD\uFFFD");            // '/' in two bytes
  EXPECT_EQ(decode_utf8("\xED\xA0\x80"), U"\uFFFD\uFFFD\uFFFD");  // half a surrogate pair
  EXPECT_EQ(decode_utf8("\xF4\x90\x80\x80").front(), U'\uFFFD');  // beyond Unicode
}

TEST(Text, MakesControlCharactersSpaces) {
  EXPECT_EQ(decode_utf8(std::string_view("a\n\t\0\x7F"
                                         "b",
                                         6)),
            U"a    b");
}

TEST(Text, SetsSubscriptsOfSymbolsAlone) {
  EXPECT_EQ(marked("R_max = 2.5"), "R[max] = 2.5");
  EXPECT_EQ(marked("over λ_R, R_n"), "over λ[R], R[n]");
  EXPECT_EQ(marked("birch_2 a_b_c"), "birch_2 a[b]_c");
  EXPECT_EQ(marked("_x R_ _"), "_x R_ _");
}

}  // namespace
}  // namespace leafhull
