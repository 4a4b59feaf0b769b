// SPDX-License-Identifier: Apache-2.0
// Kernels of leaf area add up to the number of leaf layers, and a coverage is a share of the area.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "leafhull/error.h"
#include "leafhull/shape.h"
#include "property/area_measures.h"
#include "property/area_trees.h"
#include "property/extractions.h"

namespace leafhull {
namespace {

using test::at;
using test::device;
using test::Layers;
using test::shape_of;

bool says(const std::vector<std::string>& warnings, std::string_view words) {
  return std::ranges::any_of(warnings, [&](const std::string& warning) {
    return warning.find(words) != std::string::npos;
  });
}

/// A leaf of 10 x 10 around the origin, or the disc within it.
TreeModel large_leaf(bool disc) {
  TreeModel tree = test::tree_of({test::card(10, 10)});
  if (!disc) return tree;
  return test::masked(tree, test::alpha_image(512, test::opaque_inside(0.5, 0.5, 0.5, 0.5)));
}

TEST(LayersOfLeaf, AreOneOnALargeFlatLeaf) {
  for (const bool disc : {false, true}) {
    const LeafSet leaves = find_leaves(large_leaf(disc), {});
    for (const Method method : {Method::isotropic, Method::controlled, Method::uncontrolled}) {
      for (const double spacing : {0.2, 0.33, 0.4}) {
        SCOPED_TRACE(std::string(name(method)) + " " + std::to_string(spacing));
        Options options = at(Preset::paper_32);
        options.method = method;
        options.point_spacing = spacing;
        options.radius_unit = RadiusUnit::model;
        options.radius_max = 1;
        const Layers layers(extract(leaves, options, device()));
        // Near the rim N_iso is low, so kernels keep R_max there. With fine parts they add up to 5%
        // to N just inside the rim.
        const bool rim = method == Method::controlled && spacing < 0.25;
        const double most = rim ? 3.5 : 4;
        double low = HUGE_VAL, high = 0;
        for (double x = -most; x <= most; x += 0.0437) {
          for (double y = -most; y <= most; y += 0.0437) {
            if (disc && std::hypot(x, y) > most - 0.05) continue;  // texels only approximate a disc
            const double n = layers({x, y, 0});
            low = std::min(low, n);
            high = std::max(high, n);
          }
        }
        EXPECT_GT(low, 0.97);
        EXPECT_LT(high, 1.03);
      }
    }
  }
}

TEST(LayersOfLeaf, AreOneHoweverALeafLiesInTheLattice) {
  test::Random random(1);
  for (int i = 0; i < 12; ++i) {
    const Vec3d n = random.direction(), u = normalized(cross(n, random.direction()));
    const Vec3d centre = random.in_ball(1);
    Primitive leaf;
    test::add_card(leaf, centre, u * 4, cross(n, u) * 4);
    Options options = at(Preset::paper_32);
    options.method = Method::isotropic;
    options.point_spacing = 0.4;
    options.radius_unit = RadiusUnit::model;
    options.radius_max = 1;
    const Shape shape = shape_of(test::tree_of({leaf}), options);
    EXPECT_EQ(static_cast<double>(shape.kernels.size()),
              std::ceil(shape.report.leaf_area / (0.4 * 0.4)))
        << "none joined";
    const Layers layers(shape);
    for (double x = -3; x <= 3; x += 0.11) {
      for (double y = -3; y <= 3; y += 0.11) {
        ASSERT_NEAR(layers(centre + u * x + cross(n, u) * y), 1, 0.03);
      }
    }
  }
}

TEST(LeafArea, IsThatOfTheKernelsAndOfTheMask) {
  for (const TreeModel& tree :
       {test::card_tree(), test::needle_tree(), test::closed_sphere(), test::closed_box(),
        test::curved_sheet(), test::crossed_billboard()}) {
    const LeafSet leaves = find_leaves(tree, {});
    const double visible = test::visible_area(tree);
    for (const int falloff : {1, 2, 3}) {
      Options options = at(Preset::paper_32);
      options.falloff = falloff;
      const Shape shape = extract(leaves, options, device());
      double area = 0;
      for (const Kernel& k : shape.kernels) {
        area += static_cast<double>(k.weight) * std::numbers::pi *
                static_cast<double>(k.radius_major) * static_cast<double>(k.radius_minor) /
                (falloff + 1);
      }
      EXPECT_NEAR(area / visible, 1, 1e-6);
      EXPECT_NEAR(shape.report.leaf_area / visible, 1, 1e-6);
      EXPECT_EQ(shape.report.counts.leaf_points, shape.kernels.size());
    }
  }
}

/// The share of the points whose density is T or more.
double share_inside(const std::vector<double>& density, double threshold) {
  const auto inside = std::ranges::count_if(density, [&](double n) { return n >= threshold; });
  return static_cast<double>(inside) / static_cast<double>(density.size());
}

std::vector<double> density_at(std::span<const Vec3d> places, const Shape& shape) {
  const Layers layers(shape);
  std::vector<double> density;
  for (const Vec3d& place : places) density.push_back(layers(place));
  return density;
}

TEST(Coverage, IsTheShareOfLeafAreaInside) {
  for (const TreeModel& tree : {test::card_tree(), test::needle_tree()}) {
    const std::vector<Vec3d> places = test::places_on(tree, 10000);
    const LeafSet leaves = find_leaves(tree, {});
    std::vector<double> density;
    for (const double coverage : {0.5, 0.8, 0.92, 0.97}) {
      SCOPED_TRACE(coverage);
      Options options = at(Preset::draft);
      options.coverage = coverage;
      const Shape shape = extract(leaves, options, device());
      if (density.empty()) density = density_at(places, shape);  // T does not change the kernels
      EXPECT_NEAR(share_inside(density, shape.report.threshold), coverage, 0.02);
      EXPECT_NEAR(shape.report.covered, coverage, 0.005);
      EXPECT_FALSE(says(shape.report.warnings, "cannot be reached"));
    }
  }
}

TEST(Coverage, IsThatOfTheMesh) {
  const TreeModel tree = test::card_tree();
  const std::vector<Vec3d> places = test::places_on(tree, 10000);
  Options options = at(Preset::standard);
  options.coverage = 0.8;
  const Shape shape = shape_of(tree, options);
  const test::Solid solid(test::corners_of(shape.mesh), 2 * shape.report.voxel_size);
  const auto inside = std::ranges::count_if(places, [&](Vec3d p) { return solid.holds(p); });
  EXPECT_NEAR(static_cast<double>(inside) / static_cast<double>(places.size()), 0.8, 0.02);
}

TEST(Coverage, OfACrownThatIsOneSheetSaysWhatWasReached) {
  const TreeModel tree = test::sphere_of_cards();
  const std::vector<Vec3d> places = test::places_on(tree, 10000);
  for (const double coverage : {0.5, 0.9}) {
    Options options = at(Preset::draft);
    options.coverage = coverage;
    const Shape shape = shape_of(tree, options);
    const double reached = share_inside(density_at(places, shape), shape.report.threshold);
    EXPECT_NEAR(shape.report.covered, reached, 0.01);
    EXPECT_GT(reached, 0.99) << "a film would have holes";
    EXPECT_TRUE(says(shape.report.warnings, "takes in 100% of the leaf area"));
  }
}

TEST(VertexPoints, AreEveryLeafVertexOnce) {
  for (const TreeModel& tree : {test::card_tree(), test::closed_box()}) {
    const LeafSet leaves = find_leaves(tree, {});
    for (const Style style : {Style::painterly, Style::paper_thin}) {
      Options options = at(Preset::draft);
      options.style = style;
      options.points = PointSource::vertices;
      options.threshold = 0.5;
      const Shape shape = extract(leaves, options, device());
      EXPECT_EQ(shape.kernels.size(), leaves.vertices.size());
      EXPECT_EQ(shape.report.counts.leaf_points, leaves.vertices.size());
      EXPECT_TRUE(
          std::ranges::all_of(shape.kernels, [](const Kernel& k) { return k.weight == 1; }));
    }
  }
}

TEST(Radii, NeverExceedTheLargest) {
  const LeafSet leaves = find_leaves(test::card_tree(), {});
  for (const PointSource points : {PointSource::area, PointSource::vertices}) {
    for (const Method method : {Method::isotropic, Method::controlled, Method::uncontrolled}) {
      Options options = at(Preset::draft);
      options.points = points;
      options.method = method;
      options.coverage = 0.9;
      options.radius_unit = RadiusUnit::leaf;
      options.radius_max = 0.25;
      const Shape shape = extract(leaves, options, device());
      const auto most = static_cast<float>(shape.report.radius_max_model);
      EXPECT_LT(static_cast<double>(most), 0.3 * leaves.mean_radius_major);
      for (const Kernel& k : shape.kernels) {
        ASSERT_LE(std::max({k.radius_major, k.radius_minor, k.radius_normal}), most);
      }
    }
  }
}

TEST(BadInput, ATextureWithoutAVisibleTexelIsSaid) {
  TreeModel tree = test::card_tree();
  for (std::size_t i = 3; i < tree.images[0].rgba.size(); i += 4) tree.images[0].rgba[i] = 0;
  const Shape shape = shape_of(tree, at(Preset::draft));
  EXPECT_TRUE(says(shape.report.warnings, "transparent everywhere"));
  tree.images.clear();
  EXPECT_NEAR(shape.report.leaf_area / test::visible_area(tree), 1, 1e-6);
}

TEST(BadInput, MoreThanTenMillionPointsAreRefused) {
  Options options = at(Preset::draft);
  options.point_spacing = 1e-3;
  try {
    shape_of(test::card_tree(), options);
    ADD_FAILURE() << "went through";
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ErrorCode::usage);
    EXPECT_NE(std::string(error.what()).find("ten million"), std::string::npos) << error.what();
    EXPECT_NE(error.remedy().find("--point-spacing"), std::string::npos) << error.remedy();
  }
}

/// Any R_max, however small, gives a shape or an error that says what to change.
TEST(BadInput, AnyRadiusFarBelowALeafWorksOrSaysWhy) {
  const LeafSet leaves = find_leaves(test::crossed_billboard(), {});
  int shapes = 0;
  for (const double radius : {1.0, 1e-3, 1e-20}) {
    SCOPED_TRACE(radius);
    Options options = at(Preset::draft);
    options.radius_max = radius;
    try {
      shapes += !extract(leaves, options, device()).mesh.triangles.empty();
    } catch (const Error& error) {
      EXPECT_TRUE(error.code() == ErrorCode::usage || error.code() == ErrorCode::empty)
          << error.what();
      EXPECT_FALSE(error.remedy().empty()) << error.what();
    }
  }
  EXPECT_GE(shapes, 1);
  EXPECT_LT(shapes, 3);
}

}  // namespace
}  // namespace leafhull
