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

Vec3f srgb_of(double lightness, Chroma chroma) {
  return shown_srgb({lightness, chroma.real(), chroma.imag()});
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
      (chroma_of(oklab_of_srgb(style.tone.cool)) + chroma_of(oklab_of_srgb(style.tone.warm))) / 2.0;
  const Chroma shift = kShadow * (turn * tone - tone);
  for (Vec3f* pigment : {&style.shadow.cool, &style.shadow.warm}) {
    const Vec3d lab = oklab_of_srgb(*pigment);
    *pigment = srgb_of(lab.x, chroma_of(lab) + shift);
  }
  for (Wash* wash : {&style.ambient, &style.tone, &style.leaves}) {
    for (Vec3f* pigment : {&wash->cool, &wash->warm}) {
      const Vec3d lab = oklab_of_srgb(*pigment);
      *pigment = srgb_of(lab.x, turn * chroma_of(lab));
    }
  }
  return style;
}

}  // namespace leafhull::watercolour
