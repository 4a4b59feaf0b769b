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
  static const std::array<float, 256> decoded = [] {
    std::array<float, 256> table{};
    for (int i = 0; i < 256; ++i) table[i] = static_cast<float>(linear_of_srgb(i / 255.0));
    return table;
  }();
  return decoded[value];
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

Vec3f linear_of_oklab(Vec3d lab) {
  const auto cubed = [](double x) { return x * x * x; };
  const double l = cubed(lab.x + 0.3963377774 * lab.y + 0.2158037573 * lab.z);
  const double m = cubed(lab.x - 0.1055613458 * lab.y - 0.0638541728 * lab.z);
  const double s = cubed(lab.x - 0.0894841775 * lab.y - 1.2914855480 * lab.z);
  return Vec3f(Vec3d(4.0767416621 * l - 3.3077115913 * m + 0.2309699292 * s,
                     -1.2684380046 * l + 2.6097574011 * m - 0.3413193965 * s,
                     -0.0041960863 * l - 0.7034186147 * m + 1.7076147010 * s));
}

Vec3f shown_oklab(Vec3d lab) {
  lab.x = std::clamp(lab.x, 0.0, 1.0);
  const auto with_chroma = [&](double share) {
    return linear_of_oklab({lab.x, share * lab.y, share * lab.z});
  };
  const auto is_shown = [](Vec3f c) {
    return std::min({c.x, c.y, c.z}) >= 0 && std::max({c.x, c.y, c.z}) <= 1;
  };
  double shown = 0, most = 1;  // a grey can always be shown
  if (is_shown(with_chroma(1))) shown = 1;
  for (int step = 0; step < 20 && shown < 1; ++step) {
    const double middle = (shown + most) / 2;
    (is_shown(with_chroma(middle)) ? shown : most) = middle;
  }
  const auto [r, g, b] = with_chroma(shown);
  return {std::clamp(r, 0.0f, 1.0f), std::clamp(g, 0.0f, 1.0f), std::clamp(b, 0.0f, 1.0f)};
}

Vec3d oklab_of_srgb(Vec3f srgb) {
  return oklab_of(Vec3f(Vec3d(linear_of_srgb(double{srgb.x}), linear_of_srgb(double{srgb.y}),
                              linear_of_srgb(double{srgb.z}))));
}

Vec3f shown_srgb(Vec3d lab) {
  const Vec3f linear = shown_oklab(lab);
  return Vec3f(Vec3d(srgb_of_linear(linear.x), srgb_of_linear(linear.y), srgb_of_linear(linear.z)));
}

}  // namespace leafhull
