// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "colour/colour.h"
#include "watercolour/tint.h"

namespace leafhull::watercolour {
namespace {

Vec3d seen(Vec3f srgb) {
  return oklab_of(Vec3f(Vec3d(linear_of_srgb(double{srgb.x}), linear_of_srgb(double{srgb.y}),
                              linear_of_srgb(double{srgb.z}))));
}

double hue(Vec3d lab) { return std::atan2(lab.z, lab.y); }

/// The angle from a to b, in [-pi, pi].
double between(double a, double b) { return std::remainder(b - a, 2 * M_PI); }

TEST(Tint, OfTheGreenThatStylesAreMadeForChangesNothing) {
  const Style classic = shipped_style("classic"), same = tinted(classic, kLeafGreen);
  EXPECT_LT(length(same.tone.cool - classic.tone.cool), 2e-3f);
  EXPECT_LT(length(same.shadow.warm - classic.shadow.warm), 2e-3f);
}

TEST(Tint, TurnsHuesAsTheLeavesAreAndKeepsLightness) {
  for (const std::string_view name : style_names()) {
    const Style style = shipped_style(name);
    for (const Vec3f leaves :
         {Vec3f{0.5f, 0.05f, 0.03f}, {0.6f, 0.25f, 0.4f}, {0.5f, 0.3f, 0.03f}}) {
      const double turn = between(hue(oklab_of(kLeafGreen)), hue(oklab_of(leaves)));
      const Style red = tinted(style, leaves);
      for (const auto wash : {&Style::ambient, &Style::tone, &Style::leaves}) {
        const Vec3d before = seen((style.*wash).cool), after = seen((red.*wash).cool);
        EXPECT_NEAR(before.x, after.x, 0.01);
        EXPECT_NEAR(between(hue(before) + turn, hue(after)), 0, 0.05);
      }
      EXPECT_NEAR(seen(style.shadow.cool).x, seen(red.shadow.cool).x, 0.01);
      EXPECT_EQ(style.wood.cool, red.wood.cool);
      EXPECT_EQ(style.ground.warm, red.ground.warm);
    }
  }
}

TEST(Tint, OfGreyLeavesIsPale) {
  const Style classic = shipped_style("classic"), grey = tinted(classic, {0.5f, 0.51f, 0.5f});
  const auto chroma = [](Vec3f pigment) { return std::hypot(seen(pigment).y, seen(pigment).z); };
  EXPECT_LT(chroma(grey.tone.warm), 0.5 * chroma(classic.tone.warm));
  EXPECT_EQ(tinted(classic, {0, 0, 0}).tone.warm, classic.tone.warm);
}

TEST(Oklab, ThereAndBack) {
  for (const Vec3f colour : {Vec3f{0.1f, 0.3f, 0.05f}, {1, 1, 1}, {0, 0, 0}, {0.9f, 0, 0.5f}}) {
    EXPECT_LT(length(linear_of_oklab(oklab_of(colour)) - colour), 1e-4f);
  }
  EXPECT_NEAR(oklab_of({1, 1, 1}).x, 1, 1e-4);
  // A colour that cannot be shown loses chroma but keeps its lightness.
  const Vec3f shown = shown_oklab({0.9, 0.3, 0.2});
  EXPECT_LE(std::max({shown.x, shown.y, shown.z}), 1);
  EXPECT_NEAR(oklab_of(shown).x, 0.9, 1e-2);
}

TEST(Colour, HsvAndHex) {
  const Hsv green = hsv_of(linear_of_srgb(std::array<std::uint8_t, 3>{0, 255, 0}));
  EXPECT_NEAR(green.hue, 120, 1e-6);
  EXPECT_EQ(green.saturation, 1);
  EXPECT_EQ(hex_of(linear_of_srgb(std::array<std::uint8_t, 3>{0x4a, 0x7a, 0x2c})), "#4a7a2c");
  EXPECT_EQ(hsv_of({0.2f, 0.2f, 0.2f}).saturation, 0);
}

}  // namespace
}  // namespace leafhull::watercolour
