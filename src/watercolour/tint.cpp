// SPDX-License-Identifier: Apache-2.0
#include "watercolour/tint.h"

#include <algorithm>
#include <cmath>
#include <complex>

#include "colour/colour.h"

namespace leafhull::watercolour {
namespace {

using Chroma = std::complex<double>;  // the two axes of hue of Oklab

constexpr double kLeastChroma = 0.3, kMostChroma = 1.3;  // of the style's own
constexpr double kShadow = 0.5;

Vec3d lab_of(Vec3f srgb) {
  return oklab_of(Vec3f(Vec3d(linear_of_srgb(double{srgb.x}), linear_of_srgb(double{srgb.y}),
                              linear_of_srgb(double{srgb.z}))));
}

Vec3f srgb_of(double lightness, Chroma chroma) {
  const Vec3f linear = shown_oklab({lightness, chroma.real(), chroma.imag()});
  return Vec3f(Vec3d(srgb_of_linear(linear.x), srgb_of_linear(linear.y), srgb_of_linear(linear.z)));
}

Chroma chroma_of(Vec3d lab) { return {lab.y, lab.z}; }

}  // namespace

Style tinted(Style style, Vec3f leaves) {
  const Chroma made_for = chroma_of(oklab_of(kLeafGreen)), wanted = chroma_of(oklab_of(leaves));
  if (!(std::abs(wanted) > 0)) return style;
  const double share =
      std::clamp(std::sqrt(std::abs(wanted / made_for)), kLeastChroma, kMostChroma);
  const Chroma turn = share * (wanted / made_for) / std::abs(wanted / made_for);

  const Chroma tone =
      (chroma_of(lab_of(style.tone.cool)) + chroma_of(lab_of(style.tone.warm))) / 2.0;
  const Chroma shift = kShadow * (turn * tone - tone);
  for (Vec3f* pigment : {&style.shadow.cool, &style.shadow.warm}) {
    const Vec3d lab = lab_of(*pigment);
    *pigment = srgb_of(lab.x, chroma_of(lab) + shift);
  }
  for (Wash* wash : {&style.ambient, &style.tone, &style.leaves}) {
    for (Vec3f* pigment : {&wash->cool, &wash->warm}) {
      const Vec3d lab = lab_of(*pigment);
      *pigment = srgb_of(lab.x, turn * chroma_of(lab));
    }
  }
  return style;
}

}  // namespace leafhull::watercolour
