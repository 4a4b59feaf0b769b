// SPDX-License-Identifier: Apache-2.0
#include "colour/colour.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>

namespace leafhull {

double linear_of_srgb(double value) {
  return value <= 0.04045 ? value / 12.92 : std::pow((value + 0.055) / 1.055, 2.4);
}

float linear_of_srgb(std::uint8_t value) {
  static const std::array<float, 256> kTable = [] {
    std::array<float, 256> table{};
    for (int i = 0; i < 256; ++i) table[i] = static_cast<float>(linear_of_srgb(i / 255.0));
    return table;
  }();
  return kTable[value];
}

double srgb_of_linear(double value) {
  const double x = std::clamp(value, 0.0, 1.0);
  return x <= 0.0031308 ? 12.92 * x : 1.055 * std::pow(x, 1 / 2.4) - 0.055;
}

Vec3f linear_of_srgb(const std::array<std::uint8_t, 3>& srgb) {
  return {linear_of_srgb(srgb[0]), linear_of_srgb(srgb[1]), linear_of_srgb(srgb[2])};
}

std::string hex_of(Vec3f linear) {
  const auto bits = [](float c) {
    return static_cast<std::uint8_t>(std::lround(255 * srgb_of_linear(c)));
  };
  return hex_of(std::array{bits(linear.x), bits(linear.y), bits(linear.z)});
}

std::string hex_of(const std::array<std::uint8_t, 3>& srgb) {
  std::array<char, 8> text{};
  std::snprintf(text.data(), text.size(), "#%02x%02x%02x", unsigned{srgb[0]}, unsigned{srgb[1]},
                unsigned{srgb[2]});
  return text.data();
}

Hsv hsv_of(Vec3f linear) {
  const double r = srgb_of_linear(linear.x), g = srgb_of_linear(linear.y),
               b = srgb_of_linear(linear.z);
  const double value = std::max({r, g, b}), chroma = value - std::min({r, g, b});
  if (chroma <= 0) return {0, 0, value};
  double sixth = 0;
  if (value == r) {
    sixth = (g - b) / chroma;
  } else if (value == g) {
    sixth = 2 + (b - r) / chroma;
  } else {
    sixth = 4 + (r - g) / chroma;
  }
  return {sixth < 0 ? 60 * sixth + 360 : 60 * sixth, chroma / value, value};
}

Vec3d oklab_of(Vec3f linear) {
  const auto [r, g, b] = Vec3d(linear);
  const double l = std::cbrt(0.4122214708 * r + 0.5363325363 * g + 0.0514459929 * b);
  const double m = std::cbrt(0.2119034982 * r + 0.6806995451 * g + 0.1073969566 * b);
  const double s = std::cbrt(0.0883024619 * r + 0.2817188376 * g + 0.6299787005 * b);
  return {0.2104542553 * l + 0.7936177850 * m - 0.0040720468 * s,
          1.9779984951 * l - 2.4285922050 * m + 0.4505937099 * s,
          0.0259040371 * l + 0.7827717662 * m - 0.8086757660 * s};
}

}  // namespace leafhull
