// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>
#include <stb/stb_image.h>

#include <memory>

#include "leafhull/error.h"
#include "leafhull/picture.h"
#include "render/contact_sheet.h"
#include "render/type.h"
#include "render_pixels.h"

namespace leafhull {
namespace {

Picture plain(int width, int height, std::uint8_t value) {
  return {width, height,
          std::vector<std::uint8_t>(static_cast<std::size_t>(3) * width * height, value)};
}

std::vector<LabelledPicture> entries(int count, std::vector<std::string> lines) {
  return std::vector<LabelledPicture>(count, {plain(100, 80, 0), std::move(lines)});
}

bool is_blank(const Rectangle& ink) { return ink.left >= ink.right; }

TEST(RenderSheet, SizesAreKnownBefore) {
  const std::vector<LabelledPicture> pictures = entries(3, {"a label", "of lines"});
  const Picture sheet = contact_sheet("title", pictures, 2);
  const render::SheetSize size = render::contact_sheet_size("title", pictures, 2);
  EXPECT_EQ(size.width, sheet.width);
  EXPECT_EQ(size.height, sheet.height);
}

TEST(RenderSheet, APictureTooLargeForItsFileIsRefused) {
  const Picture large{32768, 32768, {}};  // nothing reads its pixels
  EXPECT_THROW(encode_png(large), Error);
  EXPECT_THROW(encode_jpeg(large, 85), Error);
}

TEST(RenderSheet, PicturesStandInRows) {
  const Picture one = contact_sheet("", entries(1, {}), 1);
  const Picture row = contact_sheet("", entries(3, {}), 3);
  const Picture two_rows = contact_sheet("", entries(4, {}), 3);
  EXPECT_EQ(row.height, one.height);
  EXPECT_EQ(two_rows.width, row.width);
  const int across = (row.width - one.width) / 2, down = two_rows.height - row.height;
  EXPECT_GT(across, 100);
  EXPECT_GT(down, 80);
  // The row holds all three pictures and nothing between them.
  const Rectangle ink = ink_of(row);
  EXPECT_EQ(ink.right - ink.left, 100 + 2 * across);
  EXPECT_EQ(ink.bottom - ink.top, 80);
  EXPECT_TRUE(is_blank(ink_of(row, {ink.left + 100, 0, ink.left + across, row.height})));
  // The fourth is below the first; the rest of its row is white.
  EXPECT_EQ(grey(two_rows, ink.left, ink.top + down), 0);
  EXPECT_TRUE(is_blank(
      ink_of(two_rows, {ink.left + across, ink.top + down, two_rows.width, two_rows.height})));
}

TEST(RenderSheet, LabelsStandUnderTheirPictures) {
  std::vector<LabelledPicture> pictures = entries(2, {});
  const Picture bare = contact_sheet("", pictures, 2);
  const Rectangle whole = ink_of(bare);
  pictures[1].lines = {"T = 1.5", "λ_R = 0.5"};
  const Picture sheet = contact_sheet("", pictures, 2);
  EXPECT_EQ(sheet.width, bare.width);
  EXPECT_GT(sheet.height, bare.height);
  const int middle = sheet.width / 2;
  EXPECT_TRUE(is_blank(ink_of(sheet, {0, whole.bottom, middle, sheet.height})));
  const Rectangle label = ink_of(sheet, {middle, whole.bottom, sheet.width, sheet.height});
  ASSERT_FALSE(is_blank(label));
  EXPECT_LT(label.bottom, sheet.height);
  EXPECT_GT(label.left, middle);
  // The label is centred below its picture, which is the last one.
  EXPECT_NEAR((label.left + label.right) / 2.0, whole.right - 50, 3);
}

TEST(RenderSheet, ATitleStandsAbove) {
  const Picture bare = contact_sheet("", entries(1, {}), 1);
  const Picture sheet = contact_sheet("birch", entries(1, {}), 1);
  const int title = sheet.height - bare.height;
  EXPECT_GT(title, 0);
  EXPECT_FALSE(is_blank(ink_of(sheet, {0, 0, sheet.width, ink_of(bare).top + title})));
}

TEST(RenderSheet, LongTextsAreNotCutOff) {
  const std::string text(60, 'm');
  for (const Picture& sheet :
       {contact_sheet(text, entries(2, {}), 2), contact_sheet("", entries(2, {text}), 2)}) {
    const Rectangle ink = ink_of(sheet);
    EXPECT_GT(ink.left, 0);
    EXPECT_LT(ink.right, sheet.width);
  }
}

TEST(RenderSheet, NothingAndNoColumnsGiveASheet) {
  EXPECT_TRUE(is_blank(ink_of(contact_sheet("", {}, 3))));
  EXPECT_FALSE(is_blank(ink_of(contact_sheet("nothing", {}, 0))));
  EXPECT_EQ(contact_sheet("", entries(2, {}), 0).rgb, contact_sheet("", entries(2, {}), 1).rgb);
  EXPECT_EQ(contact_sheet("", entries(2, {}), 99).rgb, contact_sheet("", entries(2, {}), 2).rgb);
}

TEST(RenderType, DrawsEveryCharacterOfOurLabels) {
  const auto drawn = [](std::string_view text) {
    Picture paper = plain(200, 60, 255);
    render::Type(30).draw(text, 100, 40, 0, paper);
    return paper.rgb;
  };
  const auto missing = drawn("\U0010FFFF");  // no typeface has it
  EXPECT_NE(missing, drawn(""));
  for (const std::string_view text : {"λ", "×", "·", "–", "≥", "µ", "é", "%", "…"}) {
    EXPECT_NE(drawn(text), missing) << text;
    EXPECT_NE(drawn(text), drawn("")) << text;
  }
}

TEST(RenderType, SubscriptsAreLowAndSmall) {
  const auto ink = [](std::string_view text) {
    Picture paper = plain(300, 100, 255);
    render::Type(40).draw(text, 150, 50, 0, paper);
    return ink_of(paper);
  };
  EXPECT_GT(ink("R_m").bottom, ink("Rm").bottom);
  EXPECT_LT(ink("R_m").right - ink("R_m").left, ink("Rm").right - ink("Rm").left);
}

TEST(RenderType, CutsOffWhatLiesOutside) {
  Picture paper = plain(10, 10, 255);
  render::Type(40).draw("wide", 0, 0, 0, paper);
  render::Type(40).draw("wide", 10, 30, 0, paper);
  EXPECT_FALSE(is_blank(ink_of(paper)));
}

TEST(RenderPng, ComesBackAsItWas) {
  Picture picture = plain(13, 7, 0);
  for (std::size_t i = 0; i < picture.rgb.size(); ++i) picture.rgb[i] = i * 89 % 256;
  const std::vector<std::uint8_t> file = encode_png(picture);
  int width = 0, height = 0, channels = 0;
  const std::unique_ptr<stbi_uc, void (*)(void*)> pixels(
      stbi_load_from_memory(file.data(), static_cast<int>(file.size()), &width, &height, &channels,
                            0),
      &stbi_image_free);
  ASSERT_TRUE(pixels);
  EXPECT_EQ(width, 13);
  EXPECT_EQ(height, 7);
  EXPECT_EQ(channels, 3);
  EXPECT_EQ(std::vector<std::uint8_t>(pixels.get(), pixels.get() + picture.rgb.size()),
            picture.rgb);
}

}  // namespace
}  // namespace leafhull
