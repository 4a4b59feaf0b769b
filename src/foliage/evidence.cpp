// SPDX-License-Identifier: Apache-2.0
#include "foliage/evidence.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "colour/colour.h"

namespace leafhull {
namespace {

/// The value of a polyline at x; outside it, that of the nearer end.
template <std::size_t N>
double along(const std::array<std::array<double, 2>, N>& line, double x) {
  if (x <= line[0][0]) return line[0][1];
  for (std::size_t i = 1; i < N; ++i) {
    const auto [x0, y0] = line[i - 1];
    const auto [x1, y1] = line[i];
    if (x <= x1) return y0 + (y1 - y0) * (x - x0) / (x1 - x0);
  }
  return line[N - 1][1];
}

/// The evidence of vivid colours by hue: red and orange may be autumn, blue is water or sky.
constexpr std::array<std::array<double, 2>, 13> kVivid{{{0, 0.8},
                                                        {25, 0.6},
                                                        {45, 1.0},
                                                        {60, 1.8},
                                                        {75, 2.6},
                                                        {150, 2.6},
                                                        {175, 1.2},
                                                        {200, -0.6},
                                                        {240, -0.5},
                                                        {270, 0.5},
                                                        {300, 1.5},
                                                        {345, 1.5},
                                                        {360, 0.8}}};
/// The evidence of dull colours by hue: bark is brown, stone grey, shaded leaves are still green.
constexpr std::array<std::array<double, 2>, 11> kDull{{{0, -2},
                                                       {38, -2},
                                                       {55, -0.6},
                                                       {68, 1},
                                                       {85, 2},
                                                       {150, 2},
                                                       {180, 0.3},
                                                       {200, -1},
                                                       {280, -0.5},
                                                       {320, 0.6},
                                                       {360, -2}}};

double share(double x, double low, double high) {
  return std::clamp((x - low) / (high - low), 0.0, 1.0);
}

}  // namespace

double colour_evidence(Vec3f linear) {
  const Hsv hsv = hsv_of(linear);
  // Brown is dark orange: how vivid a warm colour is tells bark from autumn.
  const double vivid = share(hsv.saturation * hsv.value, 0.3, 0.5);
  const double full = (1 - vivid) * along(kDull, hsv.hue) + vivid * along(kVivid, hsv.hue);
  const double grey = hsv.value > 0.8 ? -0.4 : hsv.value < 0.15 ? -0.6 : -1.4;
  const bool is_rosy = hsv.hue > 290 && hsv.value > 0.6;  // pale blossom is hardly coloured
  const double coloured =
      is_rosy ? share(hsv.saturation, 0.05, 0.15) : share(hsv.saturation, 0.08, 0.22);
  return (1 - coloured) * grey + coloured * (is_rosy ? std::max(full, 1.2) : full);
}

double alpha_evidence(const Appearance& look, AlphaMode mode, bool image_unread) {
  if (mode == AlphaMode::opaque) return look.cut > 0.05 && look.cut < 0.97 ? 1.5 : 0;
  if (image_unread) return 1.5;
  return look.cut > 0.02 ? 3 * share(look.cut, 0, 0.12) : 0;
}

double shape_evidence(const Appearance& look, std::size_t instances) {
  const auto count = static_cast<double>(look.pieces * instances);
  const double many = share(std::log10(std::max(count, 1.0)), 0.7, 2);  // from 5 to 100
  const double small = 1 - share(look.piece_length, 0.3, 0.7);
  const double flats = look.forms.flat * (0.2 + 1.8 * many * small);
  // Fruit are small lobes, crowns large ones.
  const double lobes = look.forms.lobe * (-0.7 + 2.0 * share(look.piece_length, 0.04, 0.2));
  return flats + lobes - 2.2 * look.forms.tube - 4 * look.forms.slab;
}

double place_evidence(double height) { return 1.6 * std::clamp(height - 0.4, -0.5, 0.4); }

}  // namespace leafhull
