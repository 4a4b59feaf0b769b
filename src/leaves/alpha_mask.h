// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <optional>
#include <vector>

#include "leafhull/leaves.h"

namespace leafhull {

/// A rectangle in texture space, bounds included.
struct UvBox {
  Vec2d low, high;
};

/// The part of a material's texture that is not cut away: alpha at or above the cutoff.
class AlphaMask {
 public:
  /// Nothing where the material is opaque, its image is missing, or no texel is cut away.
  /// `images` outlives the mask.
  static std::optional<AlphaMask> of(const Material& material, const std::vector<Image>& images);

  /// The ellipse with the moments of the mask inside the box: half axes of two standard deviations
  /// along its principal directions. Nothing where the mask is empty there.
  std::optional<TextureEllipse> ellipse(const UvBox& box);

 private:
  /// Texel columns and rows, bounds included; outside the image as the wrap modes continue it.
  struct Texels {
    std::int64_t left, right, top, bottom;
    auto operator<=>(const Texels&) const = default;
  };

  AlphaMask(const Material& material, const Image& image);
  std::optional<TextureEllipse> moments(const Texels& texels) const;

  const Image* image_;
  Wrap wrap_u_, wrap_v_;
  std::array<bool, 256> kept_;  ///< by alpha
  std::map<Texels, std::optional<TextureEllipse>> ellipses_;
};

}  // namespace leafhull
