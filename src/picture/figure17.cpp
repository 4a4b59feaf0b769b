// SPDX-License-Identifier: Apache-2.0
// Figure 17, p. 56: thin, fat and the previous method; Phong shading left, watercolour right.
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <ranges>
#include <string>
#include <utility>

#include "leafhull/error.h"
#include "leafhull/render.h"
#include "output/transaction.h"
#include "picture/artist.h"
#include "picture/check_picture.h"
#include "picture/parts.h"
#include "picture/side_by_side.h"
#include "render/contact_sheet.h"
#include "text/numbers.h"

namespace leafhull {
namespace {

struct Row {
  Style own, paper;
  const char* caption;
  Style style(Plate plate) const { return plate == Plate::own ? own : paper; }
};
constexpr std::array<Row, 3> kRows{
    {{Style::thin, Style::paper_thin, "(a) Thin abstract shape."},
     {Style::fat, Style::paper_fat, "(b) Fat abstract shape."},
     {Style::previous, Style::paper_previous, "(c) The previous method."}}};

/// With one decimal as in the paper, or with as many as needed.
std::string decimal(double value) {
  const bool one = std::abs(10 * value - std::round(10 * value)) < 1e-6;
  return one ? fixed(value, 1) : significant(value, 3);
}

std::string parameters(const Report& report) {
  const Options& options = report.options;
  const bool crown = options.radius_unit == RadiusUnit::crown;
  const double radius = crown ? *options.radius_max : report.radius_max_model;
  if (options.coverage) {
    const std::string outside = decimal(100 * (1 - report.covered)) + "% of the leaf area outside";
    return "(R_max = " + decimal(radius) + ", " + outside + ")";
  }
  if (options.method == Method::isotropic) {
    return "(R_i = " + decimal(radius) + ", T = " + decimal(report.threshold) + ")";
  }
  return "(R_max = " + decimal(radius) + ", T = " + decimal(report.threshold) +
         ", λ_R = " + decimal(*options.flatness) + ")";
}

/// Whether a plate of pictures of this size is a PNG file: its bytes with one more for each line
/// are counted in an int.
bool fits_a_file(int width, int height) {
  std::vector<LabelledPicture> rows;
  for (const Row& row : kRows) {
    const Picture blank{row_width(width, 2), height, {}};
    rows.push_back({blank, {row.caption, ""}});
  }
  const auto [across, down] = render::contact_sheet_size("", rows, 1);
  const std::int64_t line = 3 * std::int64_t{across} + 1;
  return line * down <= std::numeric_limits<int>::max();
}

Options options_of(const Row& row, Plate plate, Options options) {
  options.style = row.style(plate);
  options.method.reset();
  return options;
}

/// A frame that holds the wood and the leaves of every row.
Frame frame_of_rows(const TreeModel& tree, const LeafSet& leaves, Plate plate,
                    const Options& options) {
  double radius = 0;
  for (const Row& row : kRows) {
    const Options resolved = resolve(options_of(row, plate, options));
    radius = std::max(radius, radius_max_in_model_units(leaves, resolved));
  }
  Frame frame = frame_of(leaves, radius);
  add_positions(tree, tree.instances, frame);
  return frame;
}

}  // namespace

void check_figure17(const PictureOptions& picture, const DeviceInfo* device) {
  check_sides(picture);
  const auto [width, height] = std::pair(picture.width, picture.height);
  if (!fits_a_file(width, height)) {
    const auto scaled = [](int side, int most) {
      return std::max(1, static_cast<int>(std::int64_t{side} * most / kLargestSide));
    };
    const auto fits = [&](int most) {
      return fits_a_file(scaled(width, most), scaled(height, most));
    };
    const int most = *std::ranges::partition_point(std::views::iota(1, kLargestSide), fits) - 1;
    const std::string largest = size_text(scaled(width, most), scaled(height, most));
    throw Error(ErrorCode::usage,
                "the sheet of six pictures of " + size_text(width, height) +
                    " pixels is too large for a PNG file",
                "The largest of this shape that fits is " + largest + " (--size " + largest + ").");
  }
  constexpr double kPlateBytes = 3 * 6 * 2;  // six pictures, and the sheet
  PictureOptions painted = picture;
  painted.look = Look::watercolour;
  check_memory(painted, device, kPlateBytes);
}

void write_figure17(const std::shared_ptr<const TreeModel>& tree, const LeafSet& leaves,
                    const Options& options, Surfacing surfacing, const PicturePlan& plan,
                    Device& device, const Progress& progress) {
  if (!plan.plate || plan.files.png.empty()) {
    throw Error(ErrorCode::usage, "no plate is planned", "Ask for one with its .png file.");
  }
  const Plate plate = *plan.plate;
  check_figure17(plan.picture, &device.info());
  const Frame frame = frame_of_rows(*tree, leaves, plate, options);
  PictureOptions picture = plan.picture;
  Artist artist(device);
  std::vector<LabelledPicture> rows;
  for (const Row& row : kRows) {
    const auto tell = [&](std::string_view stage, double share) {
      if (!progress) return;
      const std::string of_row = std::string(name(row.style(plate))) + ": " + std::string(stage);
      progress(
          {.stage = of_row, .done = (static_cast<double>(rows.size()) + share) / kRows.size()});
    };
    // Each row consists of a surface and two pictures of it.
    const auto part = [&](int before) {
      return [&tell, before](const Advance& now) { tell(now.stage, (before + now.done) / 3); };
    };
    const Subject subject = tree_subject(
        tree, leaves, options_of(row, plate, options), surfacing, device,
        [&](const Advance& now) { tell(now.stage, 0); }, frame);
    picture.look = Look::phong;
    Picture phong = artist.draw(subject, picture, part(1)).picture;
    picture.look = Look::watercolour;
    Picture watercolour = artist.draw(subject, picture, part(2)).picture;
    const std::array looks{std::move(phong), std::move(watercolour)};
    rows.push_back({side_by_side(looks), {row.caption, parameters(*subject.report())}});
  }
  const std::vector<std::uint8_t> png = encode_png(contact_sheet("", rows, 1));
  write_file(plan.files.png.front(), {reinterpret_cast<const char*>(png.data()), png.size()});
}

}  // namespace leafhull
