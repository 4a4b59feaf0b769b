// SPDX-License-Identifier: Apache-2.0
#include "render/contact_sheet.h"

#include <algorithm>
#include <cmath>

#include "render/type.h"

namespace leafhull {
namespace render {
namespace {

constexpr std::uint8_t kInk = 34, kQuietInk = 104;

/// The measures of a sheet, in pixels.
struct Layout {
  int columns = 1, rows = 0;
  int picture_width = 0, picture_height = 0;
  int lines = 0;  ///< in the longest label
  Type title, label;
  int cell = 0;  ///< the width of a column
  int gap, margin, line_height, title_height = 0;

  Layout(std::string_view title_text, std::span<const LabelledPicture> pictures, int wanted)
      : Layout(largest(pictures)) {
    const int count = static_cast<int>(pictures.size());
    columns = std::clamp(wanted, 1, std::max(count, 1));
    rows = (count + columns - 1) / columns;
    float widest = picture_width;
    for (const LabelledPicture& entry : pictures) {
      lines = std::max(lines, static_cast<int>(entry.lines.size()));
      for (const std::string& line : entry.lines) widest = std::max(widest, label.width(line));
    }
    cell = static_cast<int>(std::ceil(widest));
    // A title wider than the row of pictures spreads them apart.
    const int room = static_cast<int>(std::ceil(title.width(title_text))) - (columns - 1) * gap;
    cell = std::max(cell, (room + columns - 1) / columns);
    if (!title_text.empty()) title_height = static_cast<int>(2 * title.size());
  }

  int label_top() const { return picture_height + line_height / 3; }
  int row_height() const { return lines > 0 ? label_top() + lines * line_height : picture_height; }
  int width() const { return 2 * margin + columns * cell + (columns - 1) * gap; }
  int height() const {
    return 2 * margin + title_height + rows * row_height() + std::max(rows - 1, 0) * gap;
  }
  int left(int column) const { return margin + column * (cell + gap); }
  int top(int row) const { return margin + title_height + row * (row_height() + gap); }

 private:
  struct Size {
    int width = 0, height = 0;
  };
  static Size largest(std::span<const LabelledPicture> pictures) {
    Size size;
    for (const auto& [picture, lines] : pictures) {
      size = {std::max(size.width, picture.width), std::max(size.height, picture.height)};
    }
    return size;
  }
  explicit Layout(Size size)
      : picture_width(size.width),
        picture_height(size.height),
        title(std::clamp(size.width / 9.0f, 18.0f, 48.0f)),
        label(std::clamp(size.width / 13.0f, 12.0f, 32.0f)),
        gap(static_cast<int>(1.2f * label.size())),
        margin(static_cast<int>(1.5f * label.size())),
        line_height(static_cast<int>(1.35f * label.size())) {}
};

void paste(const Picture& picture, int left, int top, Picture& sheet) {
  const std::size_t row = std::size_t{3} * picture.width;
  for (int y = 0; y < picture.height; ++y) {
    std::copy_n(picture.rgb.begin() + y * row, row,
                sheet.rgb.begin() + 3 * (static_cast<std::size_t>(top + y) * sheet.width + left));
  }
}

}  // namespace

SheetSize contact_sheet_size(std::string_view title, std::span<const LabelledPicture> pictures,
                             int columns) {
  const Layout layout(title, pictures, columns);
  return {layout.width(), layout.height()};
}

}  // namespace render

Picture contact_sheet(std::string_view title, std::span<const LabelledPicture> pictures,
                      int columns) {
  const render::Layout layout(title, pictures, columns);
  Picture sheet{layout.width(), layout.height(), {}};
  sheet.rgb.assign(std::size_t{3} * sheet.width * sheet.height, 255);
  layout.title.draw(title, sheet.width / 2.0f, layout.margin + layout.title.size(), render::kInk,
                    sheet);
  for (std::size_t i = 0; i < pictures.size(); ++i) {
    const auto& [picture, lines] = pictures[i];
    const int left = layout.left(static_cast<int>(i) % layout.columns);
    const int top = layout.top(static_cast<int>(i) / layout.columns);
    render::paste(picture, left + (layout.cell - picture.width) / 2, top, sheet);
    float baseline = top + layout.label_top() + layout.label.size();
    for (std::size_t line = 0; line < lines.size(); ++line, baseline += layout.line_height) {
      layout.label.draw(lines[line], left + layout.cell / 2.0f, baseline,
                        line == 0 ? render::kInk : render::kQuietInk, sheet);
    }
  }
  return sheet;
}

}  // namespace leafhull
