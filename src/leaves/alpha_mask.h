// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <tbb/concurrent_map.h>

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "leafhull/leaves.h"

namespace leafhull {

/// A rectangle in texture space, bounds included.
struct UvBox {
  Vec2d low, high;
};

/// How much of a triangle in texture space is kept, and the middle of that part.
struct KeptPart {
  double share;  ///< 0..1
  Vec2d centre;  ///< the triangle's own if nothing is kept
};

/// The part of a material's texture that is not cut away: alpha at or above the cutoff.
class AlphaMask {
 public:
  /// The mask of a material; none if it is opaque and not `cut_out`, its image is missing, or no
  /// texel is cut away.
  static std::optional<AlphaMask> of(const Material& material, const std::vector<Image>& images,
                                     bool cut_out = false);

  /// Whether any texel is kept.
  bool keeps_any() const { return kept_count_ > 0; }
  /// Whether the texel at a place in texture space is kept.
  bool keeps(Vec2d uv) const;
  /// The exact share: a texel counts by the area it has in common with the triangle. A triangle
  /// without area counts as the texel that it lies in.
  KeptPart kept_part(const std::array<Vec2d, 3>& triangle) const;

  /// The ellipse with the moments of the mask inside the box: half axes of two standard deviations
  /// along its principal directions. None if the mask is empty there. Results are cached; threads
  /// may call this at the same time.
  std::optional<TextureEllipse> ellipse(const UvBox& box);

 private:
  /// Texel columns and rows, bounds included. Outside the image the wrap modes apply.
  struct Texels {
    std::int64_t left, right, top, bottom;
    auto operator<=>(const Texels&) const = default;
  };

  AlphaMask(const Material& material, const Image& image);
  std::optional<TextureEllipse> moments(const Texels& texels) const;

  int width_, height_;
  Wrap wrap_u_, wrap_v_;
  std::vector<std::uint8_t> kept_;  ///< 1 for each kept texel, else 0; rows from the top
  std::size_t kept_count_ = 0;
  tbb::concurrent_map<Texels, std::optional<TextureEllipse>> ellipses_;
};

}  // namespace leafhull
