// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "input/file_bytes.h"
#include "leafhull/tree.h"

namespace leafhull {

/// Decodes PNG (16 bits and palettes too), JPEG, WebP, BMP, or TGA where `name` ends so. Returns an
/// empty image and sets `reason` where that is not possible.
Image decode_image(ByteSpan bytes, const std::string& name, std::string& reason);

/// The least and the greatest opacity of an image's texels.
struct OpacityRange {
  int low = 255, high = 0;
  static constexpr int kHalf = 128;

  /// Whether some texels are cut out at half of full opacity, and others not.
  bool has_holes() const { return low < kHalf && high >= kHalf; }
  bool shows_nothing() const { return high < kHalf; }
};
OpacityRange opacity_range(const Image& image);

/// A colour image, or white where it is empty, with the opacity that another shows: in its alpha
/// where it has one, else in its grey. It has the size of the opacity.
Image with_opacity(const Image& colour, Image opacity);

}  // namespace leafhull
