// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "leafhull/shape.h"
#include "leafhull/vec.h"

namespace leafhull {

/// Pixels of 8-bit sRGB, rows from the top.
struct Picture {
  int width = 0, height = 0;
  std::vector<std::uint8_t> rgb;  ///< 3 * width * height
};

/// A shaded picture of a closed mesh on white, seen from three quarters. Pictures of one `frame`
/// (model units) and size are taken from the same place and compare. A mesh without vertices is
/// white paper.
/// @throws Error usage: no pixels, or a mesh in a frame without extent; internal: the ray tracer
/// does not start.
Picture draw_shape(const Mesh& mesh, const Box& frame, int width, int height);

struct LabelledPicture {
  Picture picture;
  std::vector<std::string> lines;  ///< the label, UTF-8
};

/// Pictures of one size in rows of `columns`, each above its label, under a title.
Picture contact_sheet(std::string_view title, std::span<const LabelledPicture> pictures,
                      int columns);

/// The picture as a PNG file.
std::vector<std::uint8_t> encode_png(const Picture& picture);

/// The picture as a JPEG file: for the eye alike from a quality of 90 of 100, and a fourth of a PNG
/// file's size.
std::vector<std::uint8_t> encode_jpeg(const Picture& picture, int quality);

/// The picture that `file` is, a PNG.
/// @throws Error input: it is none.
Picture decode_png(std::span<const std::uint8_t> file);

}  // namespace leafhull
