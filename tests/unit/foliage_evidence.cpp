// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include "colour/colour.h"
#include "foliage/evidence.h"

namespace leafhull {
namespace {

double of(std::uint8_t r, std::uint8_t g, std::uint8_t b) {
  return colour_evidence(linear_of_srgb(std::array{r, g, b}));
}

TEST(ColourEvidence, SpeaksForGreenAutumnAndBlossom) {
  EXPECT_GT(of(75, 98, 62), 1.5);     // dull green
  EXPECT_GT(of(20, 60, 15), 1.5);     // dark green
  EXPECT_GT(of(60, 140, 40), 2);      // clear green
  EXPECT_GT(of(200, 180, 60), 0.5);   // yellow
  EXPECT_GT(of(210, 90, 30), 0.3);    // orange
  EXPECT_GT(of(200, 40, 40), 0.3);    // red
  EXPECT_GT(of(240, 170, 190), 1);    // pink
  EXPECT_GT(of(250, 225, 232), 0.3);  // nearly white blossom
}

TEST(ColourEvidence, SpeaksAgainstBarkStoneAndWater) {
  EXPECT_LT(of(98, 67, 62), -1);
  EXPECT_LT(of(110, 79, 54), -1);
  EXPECT_LT(of(40, 28, 20), -1);
  EXPECT_LT(of(120, 120, 120), -1);
  EXPECT_LT(of(60, 130, 200), -0.3);
  EXPECT_LT(of(230, 230, 228), 0);
}

TEST(ColourEvidence, IsFiniteForAnyColour) {
  for (int r = 0; r < 256; r += 51) {
    for (int g = 0; g < 256; g += 51) {
      for (int b = 0; b < 256; b += 51) {
        const double value = of(static_cast<std::uint8_t>(r), static_cast<std::uint8_t>(g),
                                static_cast<std::uint8_t>(b));
        EXPECT_LE(std::abs(value), 3) << r << ' ' << g << ' ' << b;
      }
    }
  }
}

TEST(AlphaEvidence, NeedsHoles) {
  Appearance look;
  EXPECT_EQ(alpha_evidence(look, AlphaMode::mask, false), 0);
  EXPECT_EQ(alpha_evidence(look, AlphaMode::blend, false), 0);
  EXPECT_GT(alpha_evidence(look, AlphaMode::mask, true), 0);  // the image cannot be read
  look.cut = 0.6;
  EXPECT_EQ(alpha_evidence(look, AlphaMode::mask, false), 3);
  EXPECT_GT(alpha_evidence(look, AlphaMode::opaque, false), 0);
  look.cut = 1;  // the alpha must mean something else
  EXPECT_EQ(alpha_evidence(look, AlphaMode::opaque, false), 0);
}

TEST(ShapeEvidence, TellsCardsAndLobesFromTubesGroundAndFruit) {
  Appearance cards{.pieces = 500, .piece_length = 0.02};
  cards.forms.flat = 1;
  Appearance one_card = cards;
  one_card.pieces = 1;
  Appearance lobes{.pieces = 3, .piece_length = 0.4};
  lobes.forms.lobe = 1;
  Appearance fruit{.pieces = 20, .piece_length = 0.02};
  fruit.forms.lobe = 1;
  Appearance tubes{.pieces = 4, .piece_length = 0.8};
  tubes.forms.tube = 1;
  Appearance slab{.pieces = 1, .piece_length = 1};
  slab.forms.slab = 1;
  EXPECT_GT(shape_evidence(cards, 1), 1.5);
  EXPECT_LT(shape_evidence(one_card, 1), 0.5);
  EXPECT_GT(shape_evidence(one_card, 500), 1.5);  // instances count
  EXPECT_GT(shape_evidence(lobes, 1), 1);
  EXPECT_LT(shape_evidence(fruit, 1), 0);
  EXPECT_LT(shape_evidence(tubes, 1), -2);
  EXPECT_LT(shape_evidence(slab, 1), -3);
}

TEST(PlaceEvidence, GrowsWithHeight) {
  EXPECT_LT(place_evidence(0), -0.5);
  EXPECT_GT(place_evidence(1), 0.5);
  EXPECT_LT(place_evidence(0.3), place_evidence(0.6));
}

}  // namespace
}  // namespace leafhull
