// SPDX-License-Identifier: Apache-2.0
#include "render/type.h"

#include <stb/stb_truetype.h>

#include <algorithm>
#include <cmath>

#include "text/text.h"

namespace leafhull {

extern const std::string_view font_open_sans;

namespace render {
namespace {

constexpr float kSubscriptSize = 0.72f, kSubscriptDrop = 0.16f;  // em

const stbtt_fontinfo& font() {
  static const stbtt_fontinfo loaded = [] {
    stbtt_fontinfo info{};
    stbtt_InitFont(&info, reinterpret_cast<const unsigned char*>(font_open_sans.data()), 0);
    return info;
  }();
  return loaded;
}

/// A glyph of a label, its origin relative to the label's beginning on the baseline.
struct Glyph {
  int index;
  float x, y, scale;
};

struct Line {
  std::vector<Glyph> glyphs;
  float width = 0;
};

Line set_line(std::string_view label, float size) {
  Line line;
  for (const TextRun& run : split_subscripts(label)) {
    const float em = run.subscript ? size * kSubscriptSize : size;
    const float scale = stbtt_ScaleForMappingEmToPixels(&font(), em);
    const float drop = run.subscript ? size * kSubscriptDrop : 0;
    int before = 0;
    for (const char32_t character : run.text) {
      const int index = stbtt_FindGlyphIndex(&font(), static_cast<int>(character));
      if (before) line.width += scale * stbtt_GetGlyphKernAdvance(&font(), before, index);
      line.glyphs.push_back({index, line.width, drop, scale});
      int advance = 0;
      stbtt_GetGlyphHMetrics(&font(), index, &advance, nullptr);
      line.width += scale * advance;
      before = index;
    }
  }
  return line;
}

void draw_glyph(const Glyph& glyph, float x, float y, std::uint8_t grey, Picture& picture) {
  const float column = std::floor(x), shift = x - column;
  int left, top, right, bottom;
  stbtt_GetGlyphBitmapBoxSubpixel(&font(), glyph.index, glyph.scale, glyph.scale, shift, 0, &left,
                                  &top, &right, &bottom);
  const int width = right - left, height = bottom - top;
  if (width <= 0 || height <= 0) return;
  std::vector<std::uint8_t> ink(static_cast<std::size_t>(width) * height);
  stbtt_MakeGlyphBitmapSubpixel(&font(), ink.data(), width, height, width, glyph.scale, glyph.scale,
                                shift, 0, glyph.index);
  for (int j = 0; j < height; ++j) {
    for (int i = 0; i < width; ++i) {
      const int px = static_cast<int>(column) + left + i;
      const int py = static_cast<int>(std::lround(y)) + top + j;
      if (px < 0 || py < 0 || px >= picture.width || py >= picture.height) continue;
      const int paper = 255 - (255 - grey) * ink[static_cast<std::size_t>(j) * width + i] / 255;
      std::uint8_t* rgb = &picture.rgb[3 * (static_cast<std::size_t>(py) * picture.width + px)];
      for (int k = 0; k < 3; ++k) rgb[k] = std::min<int>(rgb[k], paper);
    }
  }
}

}  // namespace

float Type::width(std::string_view label) const { return set_line(label, size_).width; }

void Type::draw(std::string_view label, float middle, float baseline, std::uint8_t grey,
                Picture& picture) const {
  const Line line = set_line(label, size_);
  const float left = middle - line.width / 2;
  for (const Glyph& glyph : line.glyphs) {
    draw_glyph(glyph, left + glyph.x, baseline + glyph.y, grey, picture);
  }
}

}  // namespace render
}  // namespace leafhull
