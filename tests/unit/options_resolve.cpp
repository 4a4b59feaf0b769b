// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <optional>
#include <string>
#include <utility>

#include "leafhull/error.h"
#include "leafhull/options.h"

namespace leafhull {
namespace {

Options styled(Style style) {
  Options options;
  options.style = style;
  return resolve(options);
}

/// Expects a usage error from `options`; returns its message and remedy.
std::string refusal(const Options& options) {
  try {
    resolve(options);
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ErrorCode::usage);
    EXPECT_FALSE(error.remedy().empty());
    return std::string(error.what()) + ". " + error.remedy();
  }
  ADD_FAILURE() << "resolve took the options";
  return {};
}

template <class Value>
std::string refusal_of(Value Options::*member, Value value) {
  Options options;
  options.*member = value;
  return refusal(options);
}

void expect_words(const std::string& text, std::initializer_list<std::string> words) {
  for (const std::string& word : words) {
    EXPECT_NE(text.find(word), std::string::npos) << "'" << word << "' is missing in: " << text;
  }
}

TEST(Styles, PainterlyIsTheDefaultAndHasItsValues) {
  const Options options = resolve({});
  EXPECT_EQ(options.style, Style::painterly);
  EXPECT_EQ(options.method, Method::controlled);
  EXPECT_EQ(options.radius_max, 3.5);
  EXPECT_EQ(options.coverage, 0.98);
  EXPECT_EQ(options.points, PointSource::area);
  EXPECT_EQ(options.point_spacing, 0.33);
  EXPECT_FALSE(options.threshold || options.threshold_percent);
  EXPECT_EQ(options.flatness, 0.8);
  EXPECT_EQ(options.min_component, 0.001);
}

TEST(Styles, AtVerticesAreAsTheyWereBeforeLeafArea) {
  Options options;
  options.points = PointSource::vertices;
  EXPECT_EQ(resolve(options).radius_max, 2.5);
  EXPECT_EQ(resolve(options).coverage, 0.92);
  EXPECT_EQ(resolve(options).hollows, Hollows::keep);
  options.style = Style::thin;
  EXPECT_EQ(resolve(options).radius_max, 1.4);
  EXPECT_EQ(resolve(options).threshold, 2.0);
  options.style = Style::previous;
  EXPECT_EQ(resolve(options).method, Method::isotropic);
  EXPECT_EQ(resolve(options).threshold, 1.5);
}

TEST(Styles, ThePapersFiguresHaveTheirValues) {
  const Options thin = styled(Style::paper_thin);
  EXPECT_EQ(thin.method, Method::controlled);
  EXPECT_EQ(thin.radius_max, 1.4);
  EXPECT_EQ(thin.threshold, 2.0);
  EXPECT_EQ(thin.flatness, 0.7);
  EXPECT_EQ(thin.min_component, 0);
  EXPECT_FALSE(thin.coverage || thin.threshold_percent);

  const Options fat = styled(Style::paper_fat);
  EXPECT_EQ(fat.method, Method::controlled);
  EXPECT_EQ(fat.radius_max, 1.6);
  EXPECT_EQ(fat.threshold, 2.0);
  EXPECT_EQ(fat.flatness, 1.0);
  EXPECT_EQ(fat.min_component, 0);

  const Options spheres = styled(Style::paper_previous);
  EXPECT_EQ(spheres.method, Method::isotropic);
  EXPECT_EQ(spheres.radius_max, 1.5);
  EXPECT_EQ(spheres.threshold, 1.5);
  EXPECT_EQ(spheres.min_component, 0);
  EXPECT_TRUE(spheres.flatness.has_value());
}

TEST(Styles, OfLeafAreaFillHollows) {
  for (std::size_t i = 0; i < names(Style{}).size(); ++i) {
    const Options options = styled(Style(i));
    EXPECT_EQ(options.hollows == Hollows::fill, options.points == PointSource::area)
        << names(Style{})[i];
  }
}

TEST(Styles, WhatIsGivenWins) {
  Options options;
  options.style = Style::paper_previous;
  options.method = Method::uncontrolled;
  options.radius_max = 3;
  options.flatness = 0.5;
  options.min_component = 0.25;
  options.hollows = Hollows::fill;
  const Options resolved = resolve(options);
  EXPECT_EQ(resolved.method, Method::uncontrolled);
  EXPECT_EQ(resolved.radius_max, 3);
  EXPECT_EQ(resolved.flatness, 0.5);
  EXPECT_EQ(resolved.min_component, 0.25);
  EXPECT_EQ(resolved.hollows, Hollows::fill);
  EXPECT_EQ(resolved.threshold, 1.5) << "the style sets what is left";
}

TEST(Styles, AnyThresholdReplacesTheStyles) {
  Options options;
  options.threshold = 3;
  EXPECT_EQ(resolve(options).threshold, 3);
  EXPECT_FALSE(resolve(options).coverage);

  options = {};
  options.threshold_percent = 40;
  EXPECT_EQ(resolve(options).threshold_percent, 40);
  EXPECT_FALSE(resolve(options).coverage || resolve(options).threshold);

  options = {};
  options.style = Style::paper_thin;
  options.coverage = 0.5;
  EXPECT_EQ(resolve(options).coverage, 0.5);
  EXPECT_FALSE(resolve(options).threshold);
}

TEST(Styles, AnErosionReplacesTheirThreshold) {
  for (std::size_t i = 0; i < names(Style{}).size(); ++i) {
    SCOPED_TRACE(names(Style{})[i]);
    Options options;
    options.style = Style(i);
    options.erosion = 0.1;
    EXPECT_EQ(resolve(options).erosion, 0.1);
    EXPECT_FALSE(resolve(options).threshold || resolve(options).threshold_percent);
    EXPECT_FALSE(resolve(options).coverage);
    EXPECT_EQ(resolve(options).radius_max, styled(Style(i)).radius_max);
  }
}

TEST(Styles, ADilationLeavesTheRadiusOpenAndKeepsTheCoverage) {
  for (const Style style : {Style::painterly, Style::thin, Style::fat, Style::previous}) {
    SCOPED_TRACE(name(style));
    Options options;
    options.style = style;
    options.radius_unit = RadiusUnit::leaf;
    options.dilation = 0.4;
    const Options resolved = resolve(options);
    EXPECT_EQ(resolved.dilation, 0.4);
    EXPECT_FALSE(resolved.radius_max);
    EXPECT_EQ(resolved.radius_unit, RadiusUnit::crown) << "what is found is in crown units";
    EXPECT_EQ(resolved.coverage, styled(style).coverage);
    EXPECT_FALSE(resolved.threshold || resolved.erosion);
  }
}

TEST(Resolution, StandardWhereNothingIsAsked) {
  const Options options = resolve({});
  EXPECT_EQ(options.preset, Preset::standard);
  EXPECT_EQ(options.resolution, 128);
  EXPECT_FALSE(options.voxel_size);
}

TEST(Resolution, PresetsHaveTheirVoxels) {
  const int expected[] = {32, 64, 128, 64, 128, 256, 512, 1024};
  ASSERT_EQ(std::size(expected), names(Preset{}).size());
  for (std::size_t i = 0; i < std::size(expected); ++i) {
    Options options;
    options.preset = Preset(i);
    EXPECT_EQ(resolve(options).resolution, expected[i]) << names(Preset{})[i];
  }
}

TEST(Resolution, VoxelSizeLeavesTheResolutionOpen) {
  Options options;
  options.voxel_size = 0.125;
  EXPECT_EQ(resolve(options).voxel_size, 0.125);
  EXPECT_FALSE(resolve(options).resolution || resolve(options).preset);
}

TEST(Resolve, IsIdempotent) {
  Options options;
  options.preset = Preset::fine;
  options.style = Style::paper_thin;
  const Options once = resolve(options);
  const Options twice = resolve(once);
  EXPECT_EQ(twice.resolution, once.resolution);
  EXPECT_EQ(twice.threshold, once.threshold);
  EXPECT_EQ(twice.method, once.method);
}

TEST(Resolve, IsIdempotentWithAnErosionAndADilation) {
  for (const Style style : {Style::painterly, Style::paper_thin}) {
    for (const auto& [erosion, dilation] :
         {std::pair<std::optional<double>, std::optional<double>>{0.1, 0.4},
          {0.1, {}},
          {{}, 0.4}}) {
      if (style == Style::paper_thin && !erosion) continue;
      Options options;
      options.style = style;
      options.erosion = erosion;
      options.dilation = dilation;
      const Options once = resolve(options), twice = resolve(once);
      EXPECT_EQ(twice.erosion, erosion);
      EXPECT_EQ(twice.dilation, dilation);
      EXPECT_EQ(twice.coverage, once.coverage);
      EXPECT_EQ(twice.threshold, once.threshold);
      EXPECT_EQ(twice.radius_max, once.radius_max);
      EXPECT_EQ(twice.radius_max.has_value(), !dilation);
      EXPECT_EQ(twice.radius_unit, once.radius_unit);
    }
  }
}

TEST(Contradictions, TwoThresholds) {
  Options both;
  both.threshold = 2;
  both.coverage = 0.9;
  expect_words(refusal(both), {"--threshold", "--coverage"});

  both = {};
  both.threshold = 2;
  both.threshold_percent = 40;
  expect_words(refusal(both), {"--threshold X%"});

  both = {};
  both.threshold_percent = 40;
  both.coverage = 0.9;
  expect_words(refusal(both), {"--threshold X%", "--coverage"});
}

TEST(Contradictions, AnErosionAndAThreshold) {
  for (const auto member : {&Options::threshold, &Options::threshold_percent, &Options::coverage}) {
    Options both;
    both.erosion = 0.1;
    both.*member = 0.5;
    expect_words(refusal(both), {"--erosion", "--threshold X", "--coverage"});
  }
}

TEST(Contradictions, ADilationAndWhatItFinds) {
  Options both;
  both.dilation = 0.4;
  both.threshold = 2;
  expect_words(refusal(both), {"--dilation", "--threshold", "--erosion", "--coverage"});

  both = {};
  both.dilation = 0.4;
  both.threshold_percent = 40;
  expect_words(refusal(both), {"--dilation", "--threshold", "--erosion", "--coverage"});

  both = {};
  both.dilation = 0.4;
  both.radius_max = 3;
  expect_words(refusal(both), {"--dilation", "--radius-max"});

  both = {};
  both.dilation = 0.4;
  both.coverage = 0.9;
  EXPECT_NO_THROW(resolve(both));
}

TEST(Contradictions, ADilationAndAThresholdOfTheStyle) {
  for (const Style style : {Style::paper_thin, Style::paper_fat, Style::paper_previous}) {
    Options options;
    options.style = style;
    options.dilation = 0.4;
    expect_words(refusal(options),
                 {"--style " + std::string(name(style)), "--dilation", "--erosion", "--coverage"});
    options.erosion = 0.1;
    EXPECT_NO_THROW(resolve(options));
    options.erosion.reset(), options.coverage = 0.9;
    EXPECT_NO_THROW(resolve(options));
  }
  Options at_vertices;
  at_vertices.style = Style::thin;
  at_vertices.dilation = 0.4;
  EXPECT_NO_THROW(resolve(at_vertices));
  at_vertices.points = PointSource::vertices;
  expect_words(refusal(at_vertices), {"--style thin", "--erosion"});
}

TEST(Contradictions, TwoResolutions) {
  Options both;
  both.preset = Preset::fine;
  both.resolution = 64;
  expect_words(refusal(both), {"--preset", "--resolution"});

  both = {};
  both.preset = Preset::fine;
  both.voxel_size = 0.1;
  expect_words(refusal(both), {"--preset", "--voxel-size"});

  both = {};
  both.resolution = 64;
  both.voxel_size = 0.1;
  expect_words(refusal(both), {"--resolution", "--voxel-size"});
}

TEST(Contradictions, AdaptivityIsOpenVdbs) {
  Options options;
  options.mesher = Mesher::bricks;
  EXPECT_NO_THROW(resolve(options));
  options.adaptivity = 0.5;
  expect_words(refusal(options), {"--adaptivity 0.5", "--mesher bricks", "--mesher vdb"});
}

TEST(Contradictions, BandUpsideDown) {
  Options options;
  options.band_low = 1;
  options.band_high = 0.5;
  expect_words(refusal(options), {"--band-high 0.5", "--band-low 1"});
  options.band_high = 1;
  EXPECT_NO_THROW(resolve(options)) << "p1 = p2 is a step";
}

TEST(Contradictions, BandUpsideDownInPercent) {
  Options options;
  options.band_low_percent = 60;
  options.band_high_percent = 50;
  expect_words(refusal(options), {"--band-high 50%", "--band-low 60%"});
  options.band_high_percent = 60;
  EXPECT_NO_THROW(resolve(options));
  // An end of the band that comes from the style counts too.
  options = {};
  options.style = Style::thin;
  options.band_low_percent = 81;
  expect_words(refusal(options), {"--band-high 80%", "--band-low 81%"});
}

TEST(Contradictions, AnEndOfTheBandTwice) {
  Options options;
  options.band_low = 0;
  options.band_low_percent = 30;
  expect_words(refusal(options), {"--band-low X", "--band-low X%"});
  options = {};
  options.band_high = 2;
  options.band_high_percent = 30;
  expect_words(refusal(options), {"--band-high X", "--band-high X%"});
  options.band_high.reset();
  EXPECT_NO_THROW(resolve(options)) << "ends may be of two kinds";
}

TEST(Ranges, SharesThatWouldBeAllOrNothing) {
  for (const auto member : {&Options::erosion, &Options::dilation}) {
    for (const double value : {0.0, 1.0, -0.1, 1.1}) {
      expect_words(refusal_of(member, std::optional(value)), {"out of range", "(0, 1)"});
    }
  }
}

TEST(Ranges, EveryBoundOfTheTableIsKept) {
  for (const OptionRow& row : option_table()) {
    const auto* number = std::get_if<double Options::*>(&row.member);
    const auto* optional = std::get_if<std::optional<double> Options::*>(&row.member);
    if (number == nullptr && optional == nullptr) continue;
    if (row.name == "band-low" || row.name == "band-high") continue;  // they bound each other
    const auto with = [&](double value) {
      Options options;
      if (number != nullptr) options.** number = value;
      if (optional != nullptr) options.** optional = value;
      return options;
    };
    SCOPED_TRACE(row.name);
    const double above = row.high_open ? row.high : std::nextafter(row.high, HUGE_VAL);
    const double below = row.low_open ? row.low : std::nextafter(row.low, -HUGE_VAL);
    expect_words(refusal(with(above)), {std::string(row.name), std::string(row.range)});
    expect_words(refusal(with(below)), {std::string(row.name), std::string(row.range)});
    EXPECT_NO_THROW(resolve(with(row.high_open ? std::nextafter(row.high, 0) : row.high)));
    EXPECT_NO_THROW(resolve(with(row.low_open ? std::nextafter(row.low, 1) : row.low)));
  }
}

TEST(Ranges, NotANumberAndInfinityAreRefusedEverywhere) {
  constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
  int checked = 0;
  for (const OptionRow& row : option_table()) {
    for (const double value : {kNan, HUGE_VAL, -HUGE_VAL}) {
      Options options;
      if (const auto* number = std::get_if<double Options::*>(&row.member)) {
        options.** number = value;
      } else if (const auto* real = std::get_if<std::optional<double> Options::*>(&row.member)) {
        options.** real = value;
      } else {
        continue;
      }
      expect_words(refusal(options), {std::string(row.name), "finite"});
      ++checked;
    }
  }
  EXPECT_EQ(checked, 3 * 16);
}

TEST(Ranges, WholeNumbers) {
  expect_words(refusal_of(&Options::falloff, 0), {"--falloff 0", "1, 2, 3"});
  expect_words(refusal_of(&Options::falloff, 4), {"--falloff 4"});
  expect_words(refusal_of(&Options::resolution, std::optional(0)), {"--resolution 0"});
  expect_words(refusal_of(&Options::resolution, std::optional(-128)), {"--resolution -128"});
}

TEST(Ranges, EnumerationsOutOfTheirNames) {
  expect_words(refusal_of(&Options::style, Style(99)), {"--style", "painterly"});
}

TEST(Ellipse, MustBeFiniteWithAnArea) {
  Options options;
  options.ellipse = TextureEllipse{{0.5, 0.5}, {0.5, 0}, {0, 0.25}};
  EXPECT_NO_THROW(resolve(options));
  options.ellipse->b = {1, 0};
  expect_words(refusal(options), {"--ellipse", "area"});
  options.ellipse->b = {0, HUGE_VAL};
  expect_words(refusal(options), {"--ellipse", "finite"});
}

TEST(Globs, MustNotBeEmpty) {
  Options options;
  options.leaves = {"*leaf*", ""};
  expect_words(refusal(options), {"--leaves"});
}

}  // namespace
}  // namespace leafhull
