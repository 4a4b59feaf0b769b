// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "leafhull/api.h"
#include "leafhull/leaves.h"
#include "leafhull/option_row.h"

namespace leafhull {

/// Crown units along the longest side of the leaves' bounding box. SPEC: 4.
inline constexpr double kCrownUnits = 64;

enum class Style { painterly, thin, fat, previous, paper_thin, paper_fat, paper_previous };
enum class Method { isotropic, uncontrolled, controlled };
/// Where kernels sit: at parts of leaf area, or at leaf vertices, the paper's way. SPEC: 1b.
enum class PointSource { area, vertices };
enum class RadiusUnit { crown, leaf, model };
enum class Spread { stddev, variance };
enum class DensitySource { exact, grid };
enum class Hollows { fill, keep };
enum class Mesher { vdb, bricks };
enum class Preset { paper_32, paper_64, paper_128, draft, standard, fine, ultra, film };

/// Every choice of an extraction. What is empty is set by the style or follows from another option;
/// `resolve` fills it in. `option_table()` holds ranges, units and defaults.
struct Options {
  // Input
  std::optional<Up> up;        ///< empty: as the file says, else y
  bool allow_outside = false;  ///< textures may lie outside of the tree's folder

  // Leaves
  std::vector<std::string> leaves, not_leaves;
  std::optional<LeafColour> leaves_colour;
  std::optional<Srgb> leaf_colour;  ///< the colour that leaves are drawn in
  std::optional<TextureEllipse> ellipse;
  double leaf_scale = 1;

  // Shape
  Style style = Style::painterly;
  std::optional<Method> method;
  std::optional<double> threshold;          ///< T itself
  std::optional<double> threshold_percent;  ///< T as a percentage of m
  std::optional<double> coverage;           ///< T as a quantile of N over the leaves
  std::optional<double> erosion;            ///< the share of the leaves to be left outside
  std::optional<double> dilation;           ///< the share of the shape without a leaf: finds R_max
  std::optional<double> radius_max;         ///< R_max in radius_unit
  RadiusUnit radius_unit = RadiusUnit::crown;
  std::optional<double> flatness;  ///< lambda_R
  std::optional<PointSource> points;
  std::optional<double> point_spacing;  ///< s, of PointSource::area, over R_max
  int falloff = 2;                      ///< k
  Spread spread = Spread::stddev;
  DensitySource density = DensitySource::exact;
  /// a1 and a2, or the shares of the leaves up to p1 and to p2, in percent.
  std::optional<double> band_low, band_low_percent, band_high, band_high_percent;
  std::optional<double> min_component;
  std::optional<Hollows> hollows;

  // Resolution and surface: at most one of the first three is set by a user
  std::optional<Preset> preset;
  std::optional<int> resolution;
  std::optional<double> voxel_size;  ///< model units
  bool dense = false;
  bool snap = true;
  std::optional<Mesher> mesher;  ///< without adaptivity both give the same surface
  double adaptivity = 0;         ///< only for Mesher::vdb

  ReadOptions read_options() const { return {up, allow_outside}; }
  LeafOptions leaf_options() const {
    return {leaves, not_leaves, leaves_colour, leaf_colour, ellipse, leaf_scale};
  }
};

/// The names of an enumeration's values, in order.
LEAFHULL_API std::span<const std::string_view> names(Up);
LEAFHULL_API std::span<const std::string_view> names(Style);
LEAFHULL_API std::span<const std::string_view> names(Method);
LEAFHULL_API std::span<const std::string_view> names(PointSource);
LEAFHULL_API std::span<const std::string_view> names(RadiusUnit);
LEAFHULL_API std::span<const std::string_view> names(Spread);
LEAFHULL_API std::span<const std::string_view> names(DensitySource);
LEAFHULL_API std::span<const std::string_view> names(Hollows);
LEAFHULL_API std::span<const std::string_view> names(Mesher);
LEAFHULL_API std::span<const std::string_view> names(Preset);

template <class Enum>
std::string_view name(Enum value) {
  return names(value)[static_cast<std::size_t>(value)];
}

/// The style of that name; `luft-deussen`, its name up to 0.1, is paper-previous.
/// @throws Error usage: no such name.
LEAFHULL_API Style style_named(std::string_view name);

/// Voxels along the longest side.
LEAFHULL_API int resolution_of(Preset preset);

/// `options`, checked, with the style's values where nothing was asked for. Afterwards `method`,
/// `flatness`, `points`, `point_spacing`, `min_component`, `hollows`, `mesher` and, unless a
/// dilation is, `radius_max` are set; so are exactly one of the three thresholds and the erosion, a
/// deviation or a percentage for each end of a band, and `resolution` or `voxel_size`.
/// @throws Error usage: a value out of range, or two options that contradict each other.
LEAFHULL_API Options resolve(Options options);

/// R_max in model units. `resolved` as resolve() returns them; where R_max is still to be found,
/// the style's, from which the search starts. SPEC: 4.
LEAFHULL_API double radius_max_in_model_units(const LeafSet& leaves, const Options& resolved);

LEAFHULL_API void describe(OptionLine& line, const TextureEllipse& value);
LEAFHULL_API void describe(OptionLine& line, const LeafColour& value);
LEAFHULL_API void describe(OptionLine& line, const Srgb& value);
LEAFHULL_API void check_value(const OptionLine& line, const TextureEllipse& value);
LEAFHULL_API void check_value(const OptionLine& line, const LeafColour& value);
inline void check_value(const OptionLine&, const Srgb&) {}

using OptionRow =
    RowOver<Options, bool, int, double, std::optional<int>, std::optional<double>,
            std::optional<Up>, Style, std::optional<Method>, RadiusUnit, std::optional<PointSource>,
            Spread, DensitySource, std::optional<Hollows>, std::optional<Mesher>,
            std::optional<Preset>, std::vector<std::string>, std::optional<TextureEllipse>,
            std::optional<LeafColour>, std::optional<Srgb>>;

LEAFHULL_API std::span<const OptionRow> option_table();

/// The row of that name, which must be in the table.
LEAFHULL_API const OptionRow& option_row(std::string_view name);

}  // namespace leafhull
