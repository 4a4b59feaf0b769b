// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <string>

#include "leafhull/vec.h"

namespace leafhull {

/// The linear value of an sRGB value from 0 to 1. Source: IEC 61966-2-1.
double linear_of_srgb(double value);
/// The linear value of 8 bits of sRGB.
float linear_of_srgb(std::uint8_t value);
/// The sRGB value, 0 to 1, of a linear value, which is clamped to 0..1.
double srgb_of_linear(double value);

/// The linear colour of three times 8 bits of sRGB.
Vec3f linear_of_srgb(const std::array<std::uint8_t, 3>& srgb);

/// "#4a7a2c"
std::string hex_of(Vec3f linear);
std::string hex_of(const std::array<std::uint8_t, 3>& srgb);

/// How a colour looks: hue in degrees from 0 (red, 120 is green) to 360, saturation and value from
/// 0 to 1. Hue and saturation of a grey are 0.
struct Hsv {
  double hue = 0, saturation = 0, value = 0;
};

/// The Hsv of a linear colour as sRGB shows it.
Hsv hsv_of(Vec3f linear);

/// Lightness from 0 to 1 and two axes of hue. Colours that look alike lie close; a distance of 0.02
/// is just visible. Source: Ottosson, "A perceptual color space for image processing", 2020.
Vec3d oklab_of(Vec3f linear);
/// As oklab_of(), of sRGB values from 0 to 1.
Vec3d oklab_of_srgb(Vec3f srgb);
/// The inverse of oklab_of(); channels may lie outside of 0..1.
Vec3f linear_of_oklab(Vec3d lab);
/// As linear_of_oklab(), but within 0..1, with less chroma if necessary.
Vec3f shown_oklab(Vec3d lab);
/// As shown_oklab(), in sRGB.
Vec3f shown_srgb(Vec3d lab);

/// The colour of foliage if it is unknown; linear.
inline constexpr Vec3f kLeafGreen{0.13f, 0.3f, 0.07f};

}  // namespace leafhull
