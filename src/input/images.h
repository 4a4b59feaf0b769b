// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "input/file_bytes.h"
#include "leafhull/tree.h"

namespace leafhull {

/// A colour channel from a file, clamped to 0 to 1; 1 if it is not a number.
inline double share_of(double channel) {
  if (channel < 0) return 0;
  return channel <= 1 ? channel : 1;
}

/// Decodes PNG (also 16 bits and palettes), JPEG, WebP, BMP, or TGA if `name` ends in .tga. If it
/// cannot, returns an empty image and sets `reason`.
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

/// Decides about alpha for formats that do not say whether a material is cut out: an opaque
/// material of `tree` is cut out if its image has holes. If the image shows nothing at all, the
/// material stays opaque and the tree gets a warning.
void judge_alpha(TreeModel& tree, Material& material);

/// A colour image (white if empty) with the opacity from another image: from its alpha if it has
/// any, else from its grey. The result has the size of `opacity`.
Image with_opacity(const Image& colour, Image opacity);

}  // namespace leafhull
