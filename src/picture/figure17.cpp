// SPDX-License-Identifier: Apache-2.0
// Figure 17, p. 56: thin, fat and the previous method; Phong shading left, watercolour right.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <string>
#include <utility>

#include "leafhull/error.h"
#include "leafhull/render.h"
#include "picture/artist.h"
#include "picture/parts.h"

namespace leafhull {
namespace {

struct Row {
  Style style;
  const char* caption;
};
constexpr std::array<Row, 3> kRows{{{Style::thin, "(a) Thin abstract shape."},
                                    {Style::fat, "(b) Fat abstract shape."},
                                    {Style::luft_deussen, "(c) The previous method."}}};

/// With one decimal, as the paper prints it, or as many as it takes.
std::string decimal(double value) {
  char text[32];
  const bool one = std::abs(10 * value - std::round(10 * value)) < 1e-6;
  std::snprintf(text, sizeof text, one ? "%.1f" : "%.3g", value);
  return text;
}

std::string parameters(const Report& report) {
  const Options& options = report.options;
  const bool crown = options.radius_unit == RadiusUnit::crown;
  const double radius = crown ? *options.radius_max : report.radius_max_model;
  if (options.method == Method::isotropic) {
    return "(R_i = " + decimal(radius) + ", T = " + decimal(report.threshold) + ")";
  }
  return "(R_max = " + decimal(radius) + ", T = " + decimal(report.threshold) +
         ", λ_R = " + decimal(*options.flatness) + ")";
}

/// Two pictures of one size in one, white between them.
Picture side_by_side(const Picture& left, const Picture& right) {
  const int gap = left.width / 32;
  Picture both{left.width + gap + right.width, left.height, {}};
  both.rgb.assign(std::size_t{3} * both.width * both.height, 255);
  const auto paste = [&](const Picture& picture, int column) {
    const std::size_t row = std::size_t{3} * picture.width;
    for (int y = 0; y < picture.height; ++y) {
      const std::size_t to = 3 * (static_cast<std::size_t>(y) * both.width + column);
      std::copy_n(picture.rgb.begin() + y * row, row, both.rgb.begin() + to);
    }
  };
  paste(left, 0);
  paste(right, left.width + gap);
  return both;
}

Options options_of(const Row& row, Options options) {
  options.style = row.style;
  options.method.reset();
  return options;
}

/// What holds the leaves in every row, and the wood.
Frame frame_of_rows(const TreeModel& tree, const LeafSet& leaves, const Options& options) {
  double radius = 0;
  for (const Row& row : kRows) {
    const Options resolved = resolve(options_of(row, options));
    radius = std::max(radius, radius_max_in_model_units(leaves, resolved));
  }
  Frame frame = frame_of(leaves, radius);
  for (const Instance& instance : tree.instances) {
    const std::vector<Vec3d> points = render::world_positions(tree, instance);
    frame.points.insert(frame.points.end(), points.begin(), points.end());
  }
  return frame;
}

}  // namespace

Picture figure17(const std::shared_ptr<const TreeModel>& tree, const LeafSet& leaves,
                 const Options& options, Surfacing surfacing, const PictureOptions& asked,
                 Device& device, const Progress& progress) {
  check_picture(asked, &device.info());
  const Frame frame = frame_of_rows(*tree, leaves, options);
  PictureOptions picture = asked;
  Artist artist(device);
  std::vector<LabelledPicture> rows;
  for (const Row& row : kRows) {
    const auto tell = [&](std::string_view stage, double share) {
      const double done = (static_cast<double>(rows.size()) + share) / kRows.size();
      if (progress) progress(std::string(name(row.style)) + ": " + std::string(stage), done);
    };
    // A row is a surface and two pictures of it.
    const auto part = [&](int before) {
      return [&tell, before](std::string_view stage, double share) {
        tell(stage, (before + share) / 3);
      };
    };
    const Subject subject = tree_subject(
        tree, leaves, options_of(row, options), surfacing, device,
        [&](std::string_view stage, double) { tell(stage, 0); }, frame);
    picture.look = Look::phong;
    const Picture phong = artist.draw(subject, picture, part(1)).picture;
    picture.look = Look::watercolour;
    const Picture watercolour = artist.draw(subject, picture, part(2)).picture;
    rows.push_back({side_by_side(phong, watercolour), {row.caption, parameters(subject.report())}});
  }
  return contact_sheet("", rows, 1);
}

}  // namespace leafhull
