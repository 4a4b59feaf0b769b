// SPDX-License-Identifier: Apache-2.0
// Whole extractions of shapes with a known answer and of a real tree.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <random>

#include "leafhull/error.h"
#include "leafhull/shape.h"
#include "property/area_measures.h"
#include "property/extractions.h"

namespace leafhull {
namespace {

using test::ash;
using test::device;
using test::expect_same;
using test::volume;

LeafSet leaf_set(std::vector<LeafVertex> vertices) {
  LeafSet leaves;
  leaves.vertices = std::move(vertices);
  leaves.leaf_count = 1;
  for (const LeafVertex& v : leaves.vertices) {
    leaves.bounds.include(v.position);
    leaves.mean_radius_major += static_cast<double>(v.radius_major);
  }
  leaves.crown = leaves.bounds;
  leaves.mean_radius_major /= static_cast<double>(leaves.vertices.size());
  return leaves;
}

LeafVertex leaf_at(Vec3d position, float major = 1, float minor = 1) {
  return {position, {0, 0, 1}, {1, 0, 0}, major, minor, 0};
}

Options isotropic(double radius, double threshold, double voxel_size) {
  Options options;
  options.points = PointSource::vertices;
  options.method = Method::isotropic;
  options.radius_unit = RadiusUnit::model;
  options.radius_max = radius;
  options.threshold = threshold;
  options.voxel_size = voxel_size;
  return options;
}

Options of_style(Style style, Preset preset = Preset::draft) {
  Options options;
  options.style = style;
  options.preset = preset;
  return options;
}

double area(const Mesh& mesh) {
  double sum = 0;
  for (const auto& [a, b, c] : mesh.triangles) {
    const Vec3d p(mesh.positions[a]);
    sum += length(cross(Vec3d(mesh.positions[b]) - p, Vec3d(mesh.positions[c]) - p));
  }
  return sum / 2;
}

bool closed(const Mesh& mesh) {
  std::map<std::pair<std::uint32_t, std::uint32_t>, int> balance;
  for (const auto& t : mesh.triangles) {
    for (int e = 0; e < 3; ++e) {
      const std::uint32_t a = t[e], b = t[(e + 1) % 3];
      if (++balance[{a, b}] > 1) return false;
    }
  }
  return std::all_of(balance.begin(), balance.end(), [&](const auto& edge) {
    return balance.count({edge.first.second, edge.first.first}) == 1;
  });
}

/// The area of an ellipsoid of half-axes a, b, c by the midpoint rule over its parameters.
double ellipsoid_area(double a, double b, double c) {
  constexpr int kSteps = 600;
  const double du = std::numbers::pi / kSteps, dv = 2 * std::numbers::pi / kSteps;
  double sum = 0;
  for (int i = 0; i < kSteps; ++i) {
    for (int j = 0; j < kSteps; ++j) {
      const double u = (i + 0.5) * du, v = (j + 0.5) * dv;
      const Vec3d pu(a * std::cos(u) * std::cos(v), b * std::cos(u) * std::sin(v),
                     -c * std::sin(u));
      const Vec3d pv(-a * std::sin(u) * std::sin(v), b * std::sin(u) * std::cos(v), 0);
      sum += length(cross(pu, pv)) * du * dv;
    }
  }
  return sum;
}

TEST(OneKernel, ConvergesToTheEllipsoid) {
  // R_u = 2, R_v = 1, R_n = 0.5 * R_v; N = T = 0.4 where xi = 1 - 0.4^(1/2).
  const LeafSet leaves = leaf_set({leaf_at({0.1, -0.2, 0.3}, 2, 1)});
  const double s = std::sqrt(1 - std::sqrt(0.4));
  const double exact_volume = 4.0 / 3 * std::numbers::pi * 2 * 1 * 0.5 * s * s * s;
  const double exact_area = ellipsoid_area(2 * s, s, 0.5 * s);
  double volume_error = 1, area_error = 1;
  for (const double h : {0.1, 0.05, 0.025}) {
    Options options = isotropic(2, 0.4, h);
    options.method = Method::uncontrolled;
    options.flatness = 0.5;
    const Shape shape = extract(leaves, options, device());
    EXPECT_TRUE(closed(shape.mesh));
    const double dv = std::fabs(volume(shape.mesh) / exact_volume - 1);
    const double da = std::fabs(area(shape.mesh) / exact_area - 1);
    EXPECT_LT(dv, volume_error / 2.5) << h;
    EXPECT_LT(da, area_error / 2.5) << h;
    volume_error = dv, area_error = da;
  }
  EXPECT_LT(volume_error, 0.003);
  EXPECT_LT(area_error, 0.003);
}

TEST(Octahedron, OfSixKernelsByHand) {
  // Six centres at distance 1 from the origin, R = 1.5: there xi = 4/9 and N = 6 * (5/9)^2.
  std::vector<LeafVertex> corners;
  for (const double s : {-1.0, 1.0}) {
    corners.push_back(leaf_at({s, 0, 0}));
    corners.push_back(leaf_at({0, s, 0}));
    corners.push_back(leaf_at({0, 0, s}));
  }
  const double middle = 6 * 25.0 / 81;
  const LeafSet leaves = leaf_set(corners);
  // N is largest at the origin, which is a sample.
  EXPECT_THROW(extract(leaves, isotropic(1.5, middle + 1e-4, 0.05), device()), Error);
  const Shape shape = extract(leaves, isotropic(1.5, middle - 1e-4, 0.05), device());
  EXPECT_EQ(shape.report.metrics.inside_voxels, 0u);
  EXPECT_EQ(shape.report.metrics.on_voxels, 8u);

  // N_iso at a centre: 1 from itself, nothing from its opposite 2 away, and (1/9)^2 from each of
  // four at distance sqrt 2 (xi = 8/9).
  for (const float n : shape.isotropic_density) EXPECT_NEAR(n, 1 + 4 / 81.0, 1e-6);

  // The origin is a sample, so the mesh has the octahedron's symmetry.
  const Shape wide = extract(leaves, isotropic(1.5, 1, 0.05), device());
  Box box;
  for (const Vec3f p : wide.mesh.positions) box.include(Vec3d(p));
  for (const double side : {box.high.x, box.high.y, box.high.z, -box.low.x, -box.low.y}) {
    EXPECT_NEAR(side, -box.low.z, 1e-4);
  }
}

TEST(Threshold, RaisingItNeverAddsVoxels) {
  Metrics before;
  before.inside_voxels = before.on_voxels = ~std::uint64_t{0} / 2;
  for (const double t : {0.5, 1.0, 2.0, 4.0, 6.0}) {
    Options options = of_style(Style::paper_thin);
    options.threshold = t;
    const Metrics m = extract(ash(), options, device()).report.metrics;
    EXPECT_LE(m.inside_voxels, before.inside_voxels);
    EXPECT_LE(m.inside_voxels + m.on_voxels, before.inside_voxels + before.on_voxels);
    EXPECT_GE(m.off_site_exact, before.off_site_exact);
    before = m;
  }
}

TEST(RigidMotion, LeavesTheIsotropicDensityAlone) {
  LeafSet moved = ash();
  const double c = std::cos(0.7), s = std::sin(0.7);
  moved.bounds = {};
  for (LeafVertex& v : moved.vertices) {
    const auto turn = [&](Vec3d p) { return Vec3d(c * p.x - s * p.z, p.y, s * p.x + c * p.z); };
    v.position = turn(v.position) + Vec3d(300, -70, 11);
    v.normal = Vec3f(turn(Vec3d(v.normal)));
    v.major = Vec3f(turn(Vec3d(v.major)));
    moved.bounds.include(v.position);
  }
  moved.crown = moved.bounds;
  const double radius = ash().bounds.longest_side() / 30;
  Options options = isotropic(radius, 2, ash().bounds.longest_side() / 32);
  const auto a = extract(ash(), options, device()).isotropic_density;
  const auto b = extract(moved, options, device()).isotropic_density;
  ASSERT_EQ(a.size(), b.size());
  for (std::size_t i = 0; i < a.size(); ++i) EXPECT_NEAR(a[i], b[i], 1e-4 * (1 + a[i]));
}

TEST(EqualRadii, ReproduceTheIsotropicMethod) {
  LeafSet leaves = ash();
  const auto radius = static_cast<float>(leaves.bounds.longest_side() / 40);
  for (LeafVertex& v : leaves.vertices) {
    v.radius_major = v.radius_minor = radius;
    v.normal = {0, 0, 1};
    v.major = {1, 0, 0};
  }
  Options options = isotropic(static_cast<double>(radius), 2, static_cast<double>(radius));
  const Shape isotropic_shape = extract(leaves, options, device());
  options.flatness = 1;
  for (const Method method : {Method::uncontrolled, Method::controlled}) {
    options.method = method;
    expect_same(extract(leaves, options, device()), isotropic_shape);
  }
}

TEST(Leaves, OrderAndSplittingOfVerticesChangeNothing) {
  const TreeModel tree = read_tree(LEAFHULL_EXAMPLES "/ash.glb");
  TreeModel other = tree;
  std::mt19937 random(1);
  for (Primitive& p : other.primitives) {
    // Every triangle gets its own vertices, in another order.
    Primitive split = p;
    split.positions.clear(), split.normals.clear(), split.uvs.clear();
    std::shuffle(split.triangles.begin(), split.triangles.end(), random);
    for (auto& triangle : split.triangles) {
      for (std::uint32_t& v : triangle) {
        split.positions.push_back(p.positions[v]);
        if (!p.normals.empty()) split.normals.push_back(p.normals[v]);
        if (!p.uvs.empty()) split.uvs.push_back(p.uvs[v]);
        v = static_cast<std::uint32_t>(split.positions.size() - 1);
      }
    }
    p = std::move(split);
  }
  std::shuffle(other.instances.begin(), other.instances.end(), random);
  const Options options = of_style(Style::painterly);
  expect_same(extract(find_leaves(other, {}), options, device()),
              extract(find_leaves(tree, {}), options, device()));
}

TEST(Dense, EqualsTheAdaptiveBandForEveryStyle) {
  for (const Style style :
       {Style::painterly, Style::paper_thin, Style::paper_fat, Style::paper_previous}) {
    for (const double adaptivity : {0.0, 0.1, 1.0}) {
      Options options = of_style(style, Preset::standard);
      options.adaptivity = adaptivity;
      const Shape band = extract(ash(), options, device());
      options.dense = true;
      const Shape dense = extract(ash(), options, device());
      expect_same(band, dense);
      EXPECT_LT(band.report.counts.evaluated_voxels, dense.report.counts.evaluated_voxels);
      EXPECT_TRUE(closed(band.mesh));
      EXPECT_GT(volume(band.mesh), 0);
    }
  }
}

TEST(Extraction, TwiceIsTheSameTwice) {
  const Options options = of_style(Style::painterly);
  expect_same(extract(ash(), options, device()), extract(ash(), options, device()));
}

TEST(Extraction, BothVariantsGiveTheSameShape) {
  Device work_item({.choice = "", .threads = 0, .variant = "work-item"});
  const Options options = of_style(Style::painterly);
  const Shape a = extract(ash(), options, device());
  const Shape b = extract(ash(), options, work_item);
  // A vertex may end anywhere within 5e-4 voxels of the surface.
  const double h = a.report.voxel_size;
  EXPECT_NEAR(volume(a.mesh), volume(b.mesh), 2 * 5e-4 * h * area(a.mesh));
  const auto difference = [](std::uint64_t x, std::uint64_t y) { return x > y ? x - y : y - x; };
  EXPECT_LE(difference(a.report.metrics.inside_voxels, b.report.metrics.inside_voxels), 2u);
  EXPECT_LE(difference(a.report.metrics.dilated_voxels, b.report.metrics.dilated_voxels), 2u);
}

TEST(FarFromTheOrigin, TheShapeIsTheSame) {
  // After a shift by a whole number of lattice blocks, nothing but the origin may differ by a bit.
  const double h = 0.25, radius = 0.5;
  LeafSet leaves = ash();
  LeafSet far = leaves;
  const Vec3d shift = Vec3d(10240, -20480, 5120);
  far.bounds = {};
  for (LeafVertex& v : far.vertices) {
    v.position = v.position + shift;
    far.bounds.include(v.position);
  }
  far.crown = far.bounds;
  Options options = isotropic(radius, 2, h);
  options.method = Method::controlled;
  const Shape here = extract(leaves, options, device());
  const Shape there = extract(far, options, device());
  EXPECT_EQ(here.mesh.origin, Vec3d());
  EXPECT_EQ(here.mesh.triangles, there.mesh.triangles);
  EXPECT_EQ(here.mesh.normals, there.mesh.normals);
  EXPECT_EQ(here.report.metrics.dilated_voxels, there.report.metrics.dilated_voxels);
  ASSERT_EQ(here.mesh.positions.size(), there.mesh.positions.size());
  for (std::size_t i = 0; i < here.mesh.positions.size(); ++i) {
    const Vec3d a = Vec3d(here.mesh.positions[i]) + here.mesh.origin;
    const Vec3d b = Vec3d(there.mesh.positions[i]) + there.mesh.origin - shift;
    EXPECT_LT(length(a - b), 0.01 * h);
  }
}

TEST(Coverage, IsTheFractionOfLeafVerticesKept) {
  for (const double coverage : {0.5, 0.92, 1.0}) {
    Options options = of_style(Style::painterly);
    options.points = PointSource::vertices;
    options.coverage = coverage;
    const Report report = extract(ash(), options, device()).report;
    const auto count = static_cast<double>(report.counts.leaf_vertices);
    EXPECT_NEAR(static_cast<double>(report.metrics.off_site_exact), (1 - coverage) * count, 1);
  }
}

TEST(Coverage, IsTheFractionOfTheSamplesOfLeafAreaKept) {
  for (const double coverage : {0.5, 0.92}) {
    Options options = of_style(Style::painterly);
    options.coverage = coverage;
    EXPECT_NEAR(extract(ash(), options, device()).report.covered, coverage, 1e-4);
  }
}

TEST(ThresholdPercent, IsOfTheMeanIsotropicDensity) {
  Options options = of_style(Style::painterly);
  options.threshold_percent = 50;
  const Report report = extract(ash(), options, device()).report;
  EXPECT_DOUBLE_EQ(report.threshold, report.density.mean / 2);
}

TEST(CrownUnits, ScaleWithTheTreeNotTheResolution) {
  const double side = ash().bounds.longest_side();
  for (const Preset preset : {Preset::paper_32, Preset::draft}) {
    const Report report = extract(ash(), of_style(Style::painterly, preset), device()).report;
    EXPECT_DOUBLE_EQ(report.radius_max_model, 3.5 * side / 64);
    EXPECT_DOUBLE_EQ(report.voxel_size, (side + 2 * report.radius_max_model) / report.resolution);
  }
}

TEST(Extraction, ResolutionDoesNotChangeKernelsOrThreshold) {
  const Shape coarse = extract(ash(), of_style(Style::painterly, Preset::paper_32), device());
  const Shape fine = extract(ash(), of_style(Style::painterly, Preset::standard), device());
  EXPECT_EQ(coarse.isotropic_density, fine.isotropic_density);
  EXPECT_EQ(coarse.report.threshold, fine.report.threshold);
}

TEST(GridDensity, ApproachesTheExactOne) {
  Options options = of_style(Style::painterly, Preset::standard);
  const auto exact = extract(ash(), options, device()).isotropic_density;
  options.density = DensitySource::grid;
  const auto grid = extract(ash(), options, device()).isotropic_density;
  double error = 0, sum = 0;
  for (std::size_t i = 0; i < exact.size(); ++i) {
    error += std::fabs(static_cast<double>(grid[i] - exact[i]));
    sum += static_cast<double>(exact[i]);
  }
  EXPECT_GT(error, 0);
  EXPECT_LT(error / sum, 0.05);
}

ErrorCode code_of(const Options& options) {
  try {
    extract(ash(), options, device());
  } catch (const Error& error) {
    EXPECT_FALSE(error.remedy().empty());
    return error.code();
  }
  ADD_FAILURE() << "went through";
  return ErrorCode::internal;
}

TEST(Errors, AThresholdAboveEveryDensityIsEmpty) {
  Options options = of_style(Style::painterly);
  options.threshold = 1e9;
  EXPECT_EQ(code_of(options), ErrorCode::empty);
}

TEST(Errors, AResolutionThatDoesNotFitIsRefusedWithTheLargest) {
  Options options;
  options.resolution = 1000000;
  try {
    extract(ash(), options, device());
    FAIL() << "went through";
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ErrorCode::usage);
    EXPECT_NE(std::string(error.what()).find("GiB"), std::string::npos);
    EXPECT_NE(error.remedy().find("--resolution"), std::string::npos);
  }
}

}  // namespace
}  // namespace leafhull
