// SPDX-License-Identifier: Apache-2.0
#include <cmath>

#include "leafhull/error.h"
#include "leafhull/options.h"
#include "options/messages.h"
#include "text/choice.h"
#include "text/numbers.h"

namespace leafhull {
namespace {

constexpr std::string_view kStyleNames[] = {"painterly",  "thin",      "fat",           "previous",
                                            "paper-thin", "paper-fat", "paper-previous"};
constexpr std::string_view kMethodNames[] = {"isotropic", "uncontrolled", "controlled"};
constexpr std::string_view kPointSourceNames[] = {"area", "vertices"};
constexpr std::string_view kRadiusUnitNames[] = {"crown", "leaf", "model"};
constexpr std::string_view kSpreadNames[] = {"stddev", "variance"};
constexpr std::string_view kDensityNames[] = {"exact", "grid"};
constexpr std::string_view kUpNames[] = {"y", "z"};
constexpr std::string_view kHollowsNames[] = {"fill", "keep"};
constexpr std::string_view kMesherNames[] = {"vdb", "bricks"};
constexpr std::string_view kPresetNames[] = {"paper-32", "paper-64", "paper-128", "draft",
                                             "standard", "fine",     "ultra",     "film"};
constexpr int kPresetResolutions[] = {32, 64, 128, 64, 128, 256, 512, 1024};
static_assert(std::size(kPresetNames) == std::size(kPresetResolutions));

/// Ends of the band of control: a1 and a2, or percentages of the leaves.
struct BandValues {
  double low, high;
  bool percent;
};
constexpr BandValues kPaperBand = {0, 2, false};

/// The values that a style stands for. SPEC: 4; Source: Figure 17.
struct StyleValues {
  Method method;
  PointSource points;
  double radius_max;
  std::optional<double> threshold, coverage;
  BandValues band;
  double flatness;
  double point_spacing;
  double min_component;
};

// Luft and Deussen's spheres are not flattened; a flatness of 1 keeps them round under any method.
constexpr StyleValues kPaperStyles[] = {
    {Method::controlled, PointSource::vertices, 1.4, 2.0, {}, kPaperBand, 0.7, 0.4, 0},
    {Method::controlled, PointSource::vertices, 1.6, 2.0, {}, kPaperBand, 1.0, 0.4, 0},
    {Method::isotropic, PointSource::vertices, 1.5, 1.5, {}, kPaperBand, 1.0, 0.4, 0},
};
constexpr StyleValues kStyles[] = {
    {Method::controlled, PointSource::area, 3.5, {}, 0.98, kPaperBand, 0.8, 0.33, 0.001},
    {Method::controlled, PointSource::area, 4.0, {}, 0.8, {30, 80, true}, 0.7, 0.33, 0.02},
    {Method::controlled, PointSource::area, 7.5, {}, 0.99, {50, 100, true}, 1.0, 0.33, 0.001},
    {Method::isotropic, PointSource::area, 4.0, {}, 0.96, {30, 80, true}, 1.0, 0.33, 0.005},
    kPaperStyles[0],
    kPaperStyles[1],
    kPaperStyles[2],
};
/// The first styles when kernels sit at vertices, as they were before kernels could sit elsewhere.
constexpr StyleValues kStylesAtVertices[] = {
    {Method::controlled, PointSource::vertices, 2.5, {}, 0.92, kPaperBand, 0.8, 0.4, 0.001},
    kPaperStyles[0],
    kPaperStyles[1],
    kPaperStyles[2],
};
static_assert(std::size(kStyles) == std::size(kStyleNames));

void check_contradictions(const Options& options) {
  const int thresholds = options.threshold.has_value() + options.threshold_percent.has_value() +
                         options.coverage.has_value() + options.erosion.has_value();
  if (thresholds > 1) {
    refuse_option("--threshold X, --threshold X%, --coverage and --erosion contradict each other",
                  "Give one of the four.");
  }
  if (options.dilation && (options.threshold || options.threshold_percent)) {
    refuse_option("--dilation and --threshold contradict each other",
                  "Give --erosion or --coverage in place of --threshold.");
  }
  if (options.dilation && options.radius_max) {
    refuse_option("--dilation and --radius-max contradict each other",
                  "Give one of the two: a dilation finds R_max.");
  }
  // Resolved options hold a preset beside the resolution it stands for.
  const bool same = options.preset && options.resolution == resolution_of(*options.preset);
  const int sizes =
      (options.preset && !same) + options.resolution.has_value() + options.voxel_size.has_value();
  if (sizes > 1) {
    refuse_option("--preset, --resolution and --voxel-size contradict each other",
                  "Give one of the three.");
  }
  if (options.adaptivity > 0 && options.mesher == Mesher::bricks) {
    refuse_option("--adaptivity " + shortest(options.adaptivity) + " does not apply to --mesher " +
                      std::string(name(*options.mesher)),
                  "Give --mesher vdb or leave out one of the two.");
  }
  const auto once = [](const auto& value, const auto& percent, const std::string& flag) {
    if (value && percent) {
      refuse_option(flag + " X and " + flag + " X% contradict each other", "Give one of the two.");
    }
  };
  once(options.band_low, options.band_low_percent, "--band-low");
  once(options.band_high, options.band_high_percent, "--band-high");
}

/// Checks the band of resolved options. Ends of different kinds are compared once the densities are
/// known.
void check_band(const Options& options) {
  const auto upright = [](const auto& low, const auto& high, const std::string& unit) {
    if (!low || !high || *low <= *high) return;
    const std::string least = shortest(*low) + unit;
    refuse_option("--band-high " + shortest(*high) + unit + " is below --band-low " + least,
                  "Give a --band-high of at least " + least + ".");
  };
  upright(options.band_low, options.band_high, "");
  upright(options.band_low_percent, options.band_high_percent, "%");
}

void set_band(Options& options, const BandValues& band) {
  const auto set = [&](auto& value, auto& percent, double by_style) {
    if (!value && !percent) (band.percent ? percent : value) = by_style;
  };
  set(options.band_low, options.band_low_percent, band.low);
  set(options.band_high, options.band_high_percent, band.high);
  check_band(options);
}

const StyleValues& values_of(const Options& options) {
  const auto style = static_cast<std::size_t>(options.style);
  return options.points == PointSource::vertices && style < std::size(kStylesAtVertices)
             ? kStylesAtVertices[style]
             : kStyles[style];
}

}  // namespace

std::span<const std::string_view> names(Style) { return kStyleNames; }
std::span<const std::string_view> names(Method) { return kMethodNames; }
std::span<const std::string_view> names(PointSource) { return kPointSourceNames; }
std::span<const std::string_view> names(RadiusUnit) { return kRadiusUnitNames; }
std::span<const std::string_view> names(Spread) { return kSpreadNames; }
std::span<const std::string_view> names(DensitySource) { return kDensityNames; }
std::span<const std::string_view> names(Up) { return kUpNames; }
std::span<const std::string_view> names(Hollows) { return kHollowsNames; }
std::span<const std::string_view> names(Mesher) { return kMesherNames; }
std::span<const std::string_view> names(Preset) { return kPresetNames; }

Style style_named(std::string_view name) {
  if (name == "luft-deussen") return Style::paper_previous;
  return static_cast<Style>(choice("--style", name, names(Style{})));
}

int resolution_of(Preset preset) { return kPresetResolutions[static_cast<std::size_t>(preset)]; }

void describe(OptionLine& line, const TextureEllipse&) { line.value = "cu,cv,au,av,bu,bv"; }
void describe(OptionLine& line, const LeafColour&) { line.value = "COLOUR"; }
void describe(OptionLine& line, const Srgb&) { line.value = "COLOUR"; }

void check_value(const OptionLine& line, const TextureEllipse& ellipse) {
  const auto [centre, a, b] = ellipse;
  for (const double value : {centre.x, centre.y, a.x, a.y, b.x, b.y}) {
    if (!std::isfinite(value))
      refuse_option(line.spelling + " is not finite", "Give six plain numbers.");
  }
  if (a.x * b.y == a.y * b.x) {
    refuse_option(line.spelling + " has no area", "Give two half-axes that are not parallel.");
  }
}

void check_value(const OptionLine& line, const LeafColour& colour) {
  if (!(colour.tolerance >= 0) || !std::isfinite(colour.tolerance)) {
    refuse_option(line.spelling + " has a tolerance that is negative",
                  "Distances in Oklab are 0.02 to 1.");
  }
}

double radius_max_in_model_units(const LeafSet& leaves, const Options& resolved) {
  const double radius_max = resolved.radius_max.value_or(values_of(resolved).radius_max);
  switch (resolved.radius_unit) {
    case RadiusUnit::crown:
      return radius_max * leaves.crown.longest_side() / kCrownUnits;
    case RadiusUnit::leaf:
      return radius_max * leaves.mean_radius_major;
    case RadiusUnit::model:
      return radius_max;
  }
  throw Error(ErrorCode::internal, "unknown radius unit");
}

Options resolve(Options options) {
  check_rows(option_table(), options);
  check_contradictions(options);

  const StyleValues& style = values_of(options);
  if (!options.method) options.method = style.method;
  if (options.dilation) {
    options.radius_unit = RadiusUnit::crown;
  } else if (!options.radius_max) {
    options.radius_max = style.radius_max;
  }
  if (!options.flatness) options.flatness = style.flatness;
  set_band(options, style.band);
  if (!options.points) options.points = style.points;
  if (!options.point_spacing) options.point_spacing = style.point_spacing;
  if (!options.min_component) options.min_component = style.min_component;
  if (!options.hollows) {
    options.hollows = options.points == PointSource::area ? Hollows::fill : Hollows::keep;
  }
  if (!options.mesher) options.mesher = options.adaptivity > 0 ? Mesher::vdb : Mesher::bricks;
  if (!options.threshold && !options.threshold_percent && !options.coverage && !options.erosion) {
    options.threshold = style.threshold;
    options.coverage = style.coverage;
    if (options.dilation && options.threshold) {
      refuse_option("--style " + std::string(name(options.style)) +
                        " has a threshold of its own, which contradicts --dilation",
                    "Add --erosion or --coverage.");
    }
  }
  if (!options.resolution && !options.voxel_size) {
    if (!options.preset) options.preset = Preset::standard;
    options.resolution = resolution_of(*options.preset);
  }
  return options;
}

}  // namespace leafhull
