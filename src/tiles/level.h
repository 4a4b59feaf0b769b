// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "density/control.h"
#include "leafhull/forest.h"
#include "leafhull/leaves.h"
#include "leafhull/shape.h"
#include "pipeline/stopwatch.h"
#include "tiles/tile.h"

namespace leafhull {

/// Neighbouring kernels of a model: those from `first` to `end`.
struct KernelGroup {
  Box centres;
  double reach = 0;  ///< the largest radius
  std::uint32_t first = 0, end = 0;
};

/// A tree model as it is placed, at one level of abstraction, model units.
struct ForestModel {
  std::vector<LeafPoint> leaves;
  std::vector<Kernel> kernels;  ///< one per leaf point; their radii controlled within the model
  std::vector<float> isotropic_density;  ///< N_iso at the leaf points, of the tree alone
  std::vector<float> density;            ///< N at `samples`, of the tree alone
  std::vector<Vec3d> samples;            ///< places on its leaves
  std::vector<bool> in_solid;            ///< for each sample, as in LeafPoints
  double area = 0;                       ///< of its leaf points in all; 0 where they are vertices
  double radius_max = 0;                 ///< R_max
  std::vector<KernelGroup> groups;
  Box bounds;        ///< of the kernels' centres
  Box crown;         ///< the box of the leaves without strays
  double reach = 0;  ///< the largest radius, R_max included
};

/// A level of abstraction.
///
/// At level L one leaf vertex stands for 4^L, with 2^L times the radius: far trees are seen with
/// fewer and larger leaves, on voxels 2^L times as large. So each level costs a quarter of the one
/// below. Source: Cook, Halstead, Planck and Ryu, "Stochastic Simplification of Aggregate Detail",
/// 2007.
struct ForestLevel {
  int level = 0;
  std::span<const PlacedTree> trees;  ///< the scene's, which outlives the level
  Options options;                    ///< resolved
  ControlScope scope = ControlScope::model;
  double voxel_size = 0, threshold = 0;
  double reach = 0;  ///< the largest radius of all trees, scene units
  std::vector<ForestModel> models;
  /// For ControlScope::scene: statistics of N_iso over all trees, neighbours included.
  std::optional<DensityStatistics> scene_statistics;
  ExactVolume least = 0;  ///< twelve times the least volume that a piece of surface may have
  /// The mean areas that a leaf point and a sample stand for, in model units; 0: vertices.
  double area_unit = 0, sample_unit = 0;
  std::optional<Vec3f> colour;  ///< linear mean over the leaves of all trees; none: unknown
  double error = 0;             ///< how far the surface may be from the finest, scene units
};

/// The options of the shapes, resolved. A canopy keeps its hollows: a tile cannot tell whether one
/// is closed.
Options resolved_shape(const ForestOptions& options);

/// How often each model is placed, and the trees' extremes.
struct ModelUse {
  std::uint64_t trees = 0;
  double area = 0;             ///< the sum of the factors by which areas grow
  double largest = 0;          ///< the largest stretch
  double smallest_volume = 0;  ///< the smallest factor of volumes
};
std::vector<ModelUse> model_uses(const Scene& scene);

/// The leaves of the models that are placed, empty ones for the others.
/// @throws Error as read_model does, the model named.
std::vector<LeafSet> read_models(const Scene& scene, std::span<const ModelUse> uses,
                                 const LeafOptions& options);

/// The options of each model; they differ where a dilation finds R_max model by model.
/// @throws Error as Sliders::prepare does.
std::vector<Options> shapes_of(std::span<const LeafSet> models, std::span<const ModelUse> uses,
                               const Options& resolved, Device& device);

/// The voxel size of level 0: as asked for, or from the resolution along the largest tree.
double voxel_size_of(std::span<const LeafSet> models, std::span<const ModelUse> uses,
                     std::span<const Options> shapes);

/// Prepares a level: kernels of every model and T. T as a coverage or a percentage of m is taken
/// over the leaf vertices of all trees, each tree standing alone; T itself keeps its ratio to m
/// from level to level. An erosion applies to each model: its kernels' weights are divided by its
/// own T, and T is 1. `finest`: level 0, for the other levels.
ForestLevel prepare_level(int level, const Scene& scene, std::span<const LeafSet> models,
                          std::span<const Options> shapes, double voxel_size,
                          const ForestLevel* finest, Device& device);

/// The level's `least`: the share that the options ask for, of the largest piece of the smallest
/// tree, standing alone. Computes the surface of every model.
ExactVolume least_volume(const ForestLevel& level, std::span<const ModelUse> uses, Device& device);

/// The weight of an area that grows by `growth`, relative to the mean area; an area of 0, as
/// vertices have it, counts 1.
std::uint64_t weight_of(double area, double growth, double mean_area);

/// T for a coverage of weighted densities, which it sorts; the same as threshold_for_coverage where
/// all weights are one.
double threshold_for_coverage(std::vector<WeightedDensity>& densities, double coverage);

}  // namespace leafhull
