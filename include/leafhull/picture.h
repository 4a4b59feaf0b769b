// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "leafhull/api.h"
#include "leafhull/leaves.h"
#include "leafhull/shape.h"
#include "leafhull/vec.h"

namespace leafhull {

/// Pixels of 8-bit sRGB, rows from the top.
struct Picture {
  int width = 0, height = 0;
  std::vector<std::uint8_t> rgb;  ///< 3 * width * height
};

/// What a picture must show: points, and the space within `reach` (model units) of each.
struct Frame {
  std::vector<Vec3d> points;
  double reach = 0;
};

/// The frame of the crown's leaf vertices and the space that their kernels fill, with radii up to
/// `radius_max` (model units) or the leaves' own. Strays may lie outside.
LEAFHULL_API Frame frame_of(const LeafSet& leaves, double radius_max);

/// A shaded picture of a closed mesh on white, seen from three quarters. Pictures of one `frame`
/// and size share a viewpoint, so they can be compared. A mesh without vertices gives a white one.
/// @throws Error usage: no pixels, or a mesh in a frame without extent; internal: the ray tracer
/// does not start.
LEAFHULL_API Picture draw_shape(const Mesh& mesh, const Frame& frame, int width, int height);

struct LabelledPicture {
  Picture picture;
  std::vector<std::string> lines;  ///< the label, UTF-8
};

/// Pictures of one size in rows of `columns`, each above its label, under a title.
LEAFHULL_API Picture contact_sheet(std::string_view title,
                                   std::span<const LabelledPicture> pictures, int columns);

/// The picture as a PNG file.
/// @throws Error usage: it is too large for one.
LEAFHULL_API std::vector<std::uint8_t> encode_png(const Picture& picture);

/// The picture as a JPEG file; at quality 85 it is a sixth of the PNG file's size.
/// @param quality 1 to 100.
/// @throws Error usage: it is too large for one.
LEAFHULL_API std::vector<std::uint8_t> encode_jpeg(const Picture& picture, int quality);

/// Decodes a PNG file.
/// @throws Error input: it is not a PNG.
LEAFHULL_API Picture decode_png(std::span<const std::uint8_t> file);

}  // namespace leafhull
