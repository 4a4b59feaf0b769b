// SPDX-License-Identifier: Apache-2.0
#include <algorithm>

#include "density/falloff.h"
#include "leafhull/options.h"

namespace leafhull {
namespace {

constexpr int kLargestResolution = 1'000'000;

}  // namespace

std::span<const OptionRow> option_table() {
  using Row = OptionRow;
  static const Row rows[] = {
      Row("Input", "up", &Options::up,
          "the axis of the file that points up; z raises trees that lie on their side",
          {.default_value = "as the file says, else y"}),
      Row("Input", "allow-outside", &Options::allow_outside,
          "also reads textures and buffers that a file names outside its own folder"),
      Row("Leaves", "leaves", &Options::leaves,
          "materials, meshes, nodes or paths (LOD0/Leaves) that are leaves; repeatable",
          {.range = "a glob, any case", .default_value = "found by evidence"}),
      Row("Leaves", "not-leaves", &Options::not_leaves,
          "materials, meshes, nodes or paths that are not leaves; repeatable",
          {.range = "a glob, any case", .default_value = "none"}),
      Row("Leaves", "leaves-colour", &Options::leaves_colour,
          "takes the triangles of this colour: the nearer of two classes, or within X (Oklab)",
          {.unit = "sRGB", .range = "#rrggbb, or #rrggbb,X", .default_value = "any"}),
      Row("Leaves", "leaf-colour", &Options::leaf_colour,
          "colour of the shape's material and of foliage in pictures",
          {.unit = "sRGB", .range = "#rrggbb", .default_value = "the leaves' own"}),
      Row("Leaves", "ellipse", &Options::ellipse, "a leaf's ellipse: its centre and two half-axes",
          {.unit = "texture space",
           .range = "six numbers",
           .default_value = "from the alpha texture"}),
      Row("Leaves", "leaf-scale", &Options::leaf_scale, kPositive, "multiplies every leaf radius"),
      Row("Shape", "style", &Options::style, "a set of values; other options win over it"),
      Row("Shape", "method", &Options::method, "how the kernels' radii are chosen",
          {.default_value = "by style"}),
      Row("Shape", "threshold", &Options::threshold, kPositive,
          "T, the density at the surface; X% is --threshold-percent X",
          {.unit = "density", .default_value = "by style", .percent = "threshold-percent"}),
      Row("Shape", "threshold-percent", &Options::threshold_percent, kPositive,
          "T as a percentage of the mean density at the leaves",
          {.unit = "%", .default_value = "by style"}),
      Row("Shape", "coverage", &Options::coverage, {0, 1, true},
          "finds T so that this much of the leaf area (or vertices) lies inside",
          {.unit = "fraction", .default_value = "by style"}),
      Row("Shape", "erosion", &Options::erosion, {0, 1, true, true},
          "finds T so that this much of the leaf area (or vertices) is left outside",
          {.unit = "fraction", .default_value = "by style"}),
      Row("Shape", "dilation", &Options::dilation, {0, 1, true, true},
          "finds R_max so that this much of the shape, in 64 voxels along it, holds no leaf",
          {.unit = "fraction", .default_value = "by style"}),
      Row("Shape", "radius-max", &Options::radius_max, kPositive,
          "R_max, the radius where leaves are sparse: larger is rounder",
          {.unit = "see --radius-unit", .default_value = "by style"}),
      Row("Shape", "radius-unit", &Options::radius_unit,
          "1/64 of the crown, a mean leaf radius, or the file's unit"),
      Row("Shape", "flatness", &Options::flatness, {0, 1, true},
          "lambda_R, a kernel's thickness over its width", {.default_value = "by style"}),
      Row("Shape", "points", &Options::points,
          "where kernels sit: on even parts of the leaf area, or on leaf vertices as in the paper",
          {.default_value = "by style"}),
      Row("Shape", "point-spacing", &Options::point_spacing, {0, 0.4, true},
          "s, the spacing of parts of the leaf area; smaller follows the leaves closely",
          {.unit = "R_max", .default_value = "by style"}),
      Row("Shape", "falloff", &Options::falloff, {1, kLargestFalloff},
          "k, the exponent of a kernel"),
      Row("Shape", "spread", &Options::spread, "s, the unit of --band-low and --band-high"),
      Row("Shape", "density", &Options::density,
          "density at the leaves: summed there, or from the lattice"),
      Row("Shape", "band-low", &Options::band_low, kAnyNumber,
          "a1: density up to which a kernel has R_max; X% is --band-low-percent X",
          {.unit = "s above the mean", .default_value = "by style", .percent = "band-low-percent"}),
      Row("Shape", "band-low-percent", &Options::band_low_percent, {0, 100},
          "p1 such that this much of the leaf area (or vertices) is no denser",
          {.unit = "%", .default_value = "by style"}),
      Row("Shape", "band-high", &Options::band_high, kAnyNumber,
          "a2: density from which a kernel is its leaf; X% is --band-high-percent X",
          {.unit = "s above the mean",
           .range = ">= --band-low",
           .default_value = "by style",
           .percent = "band-high-percent"}),
      Row("Shape", "band-high-percent", &Options::band_high_percent, {0, 100},
          "p2 such that this much of the leaf area (or vertices) is no denser",
          {.unit = "%", .default_value = "by style"}),
      Row("Shape", "min-component", &Options::min_component, {0, 1},
          "drops pieces below this fraction of the largest one's volume",
          {.unit = "fraction", .default_value = "by style"}),
      Row("Shape", "hollows", &Options::hollows,
          "whether cavities that cannot be reached from outside are filled or kept",
          {.default_value = "fill with --points area, else keep"}),
      Row("Resolution", "preset", &Options::preset, "a named --resolution",
          {.default_value = "standard"}),
      Row("Resolution", "resolution", &Options::resolution, {1, kLargestResolution},
          "voxels along the longest side of the crown",
          {.unit = "voxels", .default_value = "by preset"}),
      Row("Resolution", "voxel-size", &Options::voxel_size, kPositive,
          "the side of a voxel, the same for every tree",
          {.unit = "model units", .default_value = "by preset"}),
      Row("Resolution", "dense", &Options::dense, "evaluates every voxel: the same result, slower"),
      Row("Resolution", "snap", &Options::snap, "leaves the vertices where the lattice puts them",
          {.default_value = "moved onto N = T"}),
      Row("Resolution", "mesher", &Options::mesher,
          "leafhull's own mesher over bricks of samples, or OpenVDB's volume-to-mesh, which is "
          "slower",
          {.default_value = "bricks, vdb with --adaptivity"}),
      Row("Resolution", "adaptivity", &Options::adaptivity, {0, 1},
          "merges triangles where the surface is flat, most at 1; only for --mesher vdb"),
  };
  return rows;
}

const OptionRow& option_row(std::string_view name) {
  return *std::ranges::find(option_table(), name, &OptionRow::name);
}

}  // namespace leafhull
