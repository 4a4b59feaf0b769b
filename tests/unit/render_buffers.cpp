// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "render/draw_buffers.h"
#include "render/mesh_target.h"
#include "render_meshes.h"
#include "render_targets.h"

namespace leafhull::render {
namespace {

/// Looks from +z at the origin; at a distance of 5 the picture is `across` wide.
Camera from_front(double across, float aspect = 1) {
  const double degrees = 2 * std::atan(across / 2 / 5) * 180 / std::numbers::pi;
  return look_at({0, 0, 5}, {0, 0, 0}, {0, 1, 0}, degrees, aspect);
}

Buffers draw(std::span<const Target* const> targets, const Camera& camera, int width, int height,
             const Surroundings& sky = EvenSky()) {
  return draw_buffers(targets, sky, camera, width, height);
}

Ray ray_through(const Camera& camera, const Buffers& buffers, int x, int y) {
  const float across = static_cast<float>(buffers.width), down = static_cast<float>(buffers.height);
  return {camera.eye, normalized(camera.direction((x + 0.5f) / across, (y + 0.5f) / down))};
}

/// The pixel that shows a point.
std::size_t pixel_of(const Camera& camera, const Buffers& buffers, Vec3f point) {
  const Vec3f ray = point - camera.eye;
  const float depth = dot(ray, camera.forward);
  const float x = 0.5f + dot(ray, camera.right) / depth / camera.tan_x / 2;
  const float y = 0.5f - dot(ray, camera.up) / depth / camera.tan_y / 2;
  return static_cast<std::size_t>(y * static_cast<float>(buffers.height)) * buffers.width +
         static_cast<std::size_t>(x * static_cast<float>(buffers.width));
}

float apart(Vec3f a, Vec3f b) { return length(a - b); }

// The picture has more pixels than a batch has rays, and its sides are not multiples of a tile's.
TEST(RenderBuffers, ABallIsSeenWhereItStands) {
  const Ball ball({0.25f, -0.5f, 0.125f}, 1);
  const std::array<const Target*, 1> targets{&ball};
  const Camera camera = from_front(4, 301 / 263.0f);
  const Buffers buffers = draw(targets, camera, 301, 263);
  ASSERT_EQ(buffers.size(), 301u * 263u);
  int seen = 0;
  for (int y = 0; y < buffers.height; ++y) {
    for (int x = 0; x < buffers.width; ++x) {
      const std::size_t i = static_cast<std::size_t>(y) * buffers.width + x;
      const Ray ray = ray_through(camera, buffers, x, y);
      const Spot spot = ball.closest(ray);
      ASSERT_EQ(buffers.object[i], spot.object) << x << ' ' << y;
      if (!spot.hit()) {
        ASSERT_EQ(buffers.depth[i], HUGE_VALF);
        ASSERT_EQ(buffers.normal[i], Vec3f{});
        continue;
      }
      ++seen;
      ASSERT_LT(apart(buffers.position[i], spot.start), 1e-6f);
      ASSERT_LT(apart(buffers.normal[i], spot.normal), 1e-6f);
      ASSERT_NEAR(buffers.depth[i], 5 - spot.start.z, 1e-5f);
      ASSERT_EQ(buffers.color[i], spot.color);
    }
  }
  EXPECT_GT(seen, 10000);
}

TEST(RenderBuffers, WhereNothingIsAllIsPaper) {
  const Ball behind({0, 0, 20}, 1);
  const std::array<const Target*, 1> targets{&behind};
  const Buffers buffers = draw(targets, from_front(4), 9, 9);
  EXPECT_EQ(buffers.object, std::vector<Object>(81, Object::paper));
  EXPECT_EQ(buffers.foliage, std::vector<float>(81, 0));
  EXPECT_EQ(buffers.key, std::vector<float>(81, 1));
  EXPECT_TRUE(buffers.edges.empty());
  EXPECT_TRUE(draw({}, from_front(4), 9, 9).edges.empty());
}

TEST(RenderBuffers, TheNearestTargetWins) {
  const Ball foliage({0, 0, 0}, 1), wood({0.5f, 0, 1.5f}, 0.5f, Object::wood);
  const std::array<const Target*, 2> one{&foliage, &wood}, other{&wood, &foliage};
  const Camera camera = from_front(4);
  const Buffers first = draw(one, camera, 64, 64), second = draw(other, camera, 64, 64);
  EXPECT_EQ(first.object, second.object);
  EXPECT_EQ(first.depth, second.depth);
  EXPECT_EQ(first.object[pixel_of(camera, first, {0.5f, 0, 2})], Object::wood);
  EXPECT_EQ(first.object[pixel_of(camera, first, {-0.5f, 0, 0.8f})], Object::foliage);
}

TEST(RenderBuffers, WhatStandsBeforeTheLightThrowsAShadow) {
  const Ball large({0, 0, 0}, 1);
  const std::array<const Target*, 1> alone{&large};
  const Camera camera = from_front(5);
  const Buffers lit = draw(alone, camera, 400, 400);
  const Vec3f to_light = lit.to_light;
  EXPECT_NEAR(length(to_light), 1, 1e-6);
  const std::size_t top = pixel_of(camera, lit, to_light);
  EXPECT_NEAR(lit.key[top], 1, 1e-5f);
  // The dark side of the ball itself.
  EXPECT_EQ(lit.key[pixel_of(camera, lit, normalized(Vec3f{0.6f, -0.6f, 0.7f}))], 0);

  const Ball small(to_light * 2.2f, 0.4f, Object::wood);
  const std::array<const Target*, 2> both{&large, &small};
  const Buffers shaded = draw(both, camera, 400, 400);
  EXPECT_EQ(shaded.object[top], Object::foliage);
  EXPECT_EQ(shaded.key[top], 0);
  int partly = 0;
  for (std::size_t i = 0; i < shaded.size(); ++i)
    partly += shaded.key[i] > 0.1f && shaded.key[i] < 0.9f;
  EXPECT_GT(partly, 200) << "a soft rim";
}

/// Every other direction is open.
class HalfOpen : public Surroundings {
  void openness(std::span<const Spot> spots, std::span<const std::uint8_t> turns,
                std::span<float> open) const override {
    for (std::size_t i = 0; i < spots.size(); ++i) open[i] = turns[i] % 2;
  }
};

TEST(RenderBuffers, NeighboursShareTheSky) {
  const Strip wall(-10, 10, 0, Object::foliage);
  const std::array<const Target*, 1> targets{&wall};
  const Buffers buffers = draw(targets, from_front(4), 16, 16, HalfOpen());
  for (int y = 4; y < 12; ++y) {
    for (int x = 4; x < 12; ++x) EXPECT_NEAR(buffers.open[16 * y + x], 0.5f, 1e-5f);
  }
  const Buffers even = draw(targets, from_front(4), 16, 16, EvenSky(0.25f));
  for (const float open : even.open) EXPECT_NEAR(open, 0.25f, 1e-5f);
}

TEST(RenderBuffers, NeighboursOnOtherSurfacesShareNothing) {
  const Strip near(-10, 0.01f, 1, Object::foliage), far(-10, 10, -1, Object::foliage);
  const std::array<const Target*, 2> targets{&near, &far};
  class NearOpen : public Surroundings {
    void openness(std::span<const Spot> spots, std::span<const std::uint8_t>,
                  std::span<float> open) const override {
      for (std::size_t i = 0; i < spots.size(); ++i) open[i] = spots[i].start.z > 0;
    }
  };
  const Buffers buffers = draw(targets, from_front(4), 32, 32, NearOpen());
  for (std::size_t i = 0; i < buffers.size(); ++i) {
    EXPECT_NEAR(buffers.open[i], buffers.position[i].z > 0, 1e-5f) << i;
  }
}

TEST(RenderBuffers, AnEdgeCoversItsPart) {
  constexpr int kSize = 9, kMiddle = 4;  // the edge goes through the middle of column 4
  const Strip foliage(-10, 0, 0, Object::foliage), wood(0, 10, 0, Object::wood);
  const std::array<const Target*, 1> left{&foliage};
  const Buffers half = draw(left, from_front(4), kSize, kSize);
  const std::array<const Target*, 2> both{&foliage, &wood};
  const Buffers full = draw(both, from_front(4), kSize, kSize);
  for (int y = 0; y < kSize; ++y) {
    for (int x = 0; x < kSize; ++x) {
      const int i = kSize * y + x;
      if (x == kMiddle) {
        EXPECT_NEAR(half.foliage[i], 0.5f, 1.01f / 9);
      } else {
        EXPECT_EQ(half.foliage[i], x < kMiddle);
        EXPECT_EQ(full.wood[i], x > kMiddle);
      }
      EXPECT_EQ(half.wood[i], 0);
      EXPECT_NEAR(full.foliage[i] + full.wood[i], 1, 1e-6f);
    }
  }
  EXPECT_EQ(half.samples.size(), half.edges.size() * half.edge_rays);
  // The column itself, and the neighbour on the side to which its centres belong.
  EXPECT_EQ(half.edges.size(), 2u * kSize);
}

// The strip is narrower than a pixel, misses the centres, and is turned away from the light.
TEST(RenderBuffers, WhatOnlyAnEdgesRaysSeeHasItsOwnLight) {
  constexpr int kSize = 9;
  constexpr float kPixel = 4.0f / kSize;
  const Strip wall(-10, 0, 0, Object::foliage);
  const Strip twig(0.1f * kPixel, 0.4f * kPixel, 0, Object::wood, {1, 0, 0});
  const std::array<const Target*, 2> targets{&wall, &twig};
  const Buffers buffers = draw(targets, from_front(4), kSize, kSize, EvenSky(0.25f));
  int seen = 0;
  for (const EdgeSample& sample : buffers.samples) {
    if (sample.object == Object::foliage) {
      EXPECT_NEAR(sample.key, 1, 1e-5f);
    }
    if (sample.object != Object::wood) continue;
    ++seen;
    EXPECT_EQ(sample.key, 0);
    EXPECT_EQ(sample.open, 0.25f);
    EXPECT_EQ(sample.normal, (Vec3f{1, 0, 0}));
  }
  EXPECT_GT(seen, 0);
  EXPECT_EQ(std::count(buffers.object.begin(), buffers.object.end(), Object::wood), 0);
}

TEST(RenderBuffers, SixteenRaysInTurnAreNeighbours) {
  class Listener : public SimpleTarget {
   public:
    using SimpleTarget::closest;
    Spot closest(const Ray& ray) const override {
      rays.push_back(ray);
      return {};
    }
    mutable std::vector<Ray> rays;
  };
  const Listener listener;
  const std::array<const Target*, 1> targets{&listener};
  draw(targets, from_front(1, 50 / 30.0f), 50, 30);
  ASSERT_EQ(listener.rays.size(), 52u * 32u);
  for (std::size_t i = 0; i < listener.rays.size(); ++i) {
    const Ray &first = listener.rays[i / 16 * 16], &ray = listener.rays[i];
    EXPECT_LT(apart(ray.direction, first.direction), 5 * 0.2f / 50);
  }
}

class RenderMesh : public ::testing::Test {
 protected:
  Mesh mesh_ = sphere({0, 0, 0}, 1);
  DeviceHandle embree_ = open_embree();
  Scene scene_{embree_.get(), {make_surface(embree_.get(), mesh_, Placement{})}};
  MeshTarget target_{scene_};
  std::array<const Target*, 1> targets_{&target_};
};

TEST_F(RenderMesh, IsSeenAsTheBallItStandsFor) {
  const Ball ball({0, 0, 0}, 1);
  const std::array<const Target*, 1> balls{&ball};
  const Camera camera = from_front(3);
  const Buffers of_mesh = draw(targets_, camera, 120, 120), of_ball = draw(balls, camera, 120, 120);
  int differ = 0, both = 0;
  for (std::size_t i = 0; i < of_mesh.size(); ++i) {
    differ += of_mesh.object[i] != of_ball.object[i];
    if (of_mesh.object[i] == Object::paper || of_ball.object[i] == Object::paper) continue;
    ++both;
    EXPECT_GT(dot(of_mesh.normal[i], of_ball.normal[i]), 0.995f);
  }
  EXPECT_LT(differ, both / 50);
  EXPECT_GT(both, 4000);
}

TEST_F(RenderMesh, TheSkyIsHiddenWhereSomethingIsNear) {
  const Spot free{1, Object::foliage, {0, 0, 1.001f}, {0, 0, 1}, {0, 0, 1}, {}};
  const Spot inside{1, Object::foliage, {0, 0, 0.9f}, {0, 0, 1}, {0, 0, 1}, {}};
  const Spot deep{1,         Object::foliage, {0, 0, 0},
                  {0, 0, 1}, {0, 0, 1},       {}};  // farther inside than things shade
  const std::array spots{free, inside, deep, Spot{}};
  const MeshSurroundings sky(targets_);
  for (std::uint8_t turn = 0; turn < Surroundings::kTurns; ++turn) {
    std::array<float, 4> open{};
    sky.openness(spots, std::array{turn, turn, turn, turn}, open);
    EXPECT_EQ(open[0], 1) << int{turn};
    EXPECT_EQ(open[1], 0) << int{turn};
    EXPECT_EQ(open[2], 1) << int{turn};
  }
}

std::optional<Hit> closest(const Scene& scene, const Ray& ray) {
  std::optional<Hit> hit;
  scene.closest({&ray, 1}, {&hit, 1});
  return hit;
}

TEST_F(RenderMesh, RaysInPacketsFindWhatSingleRaysFind) {
  const Camera camera = from_front(2.2);
  std::vector<Ray> rays;
  for (int i = 0; i < 1000; ++i) {  // not a whole number of packets, and some rays miss
    rays.push_back({camera.eye, normalized(camera.direction(i % 40 / 40.0f, i / 25 / 40.0f))});
  }
  std::vector<Spot> spots(rays.size());
  target_.closest(rays, spots);
  int hits = 0;
  for (std::size_t i = 0; i < rays.size(); ++i) {
    const std::optional<Hit> hit = closest(scene_, rays[i]);
    ASSERT_EQ(spots[i].hit(), hit.has_value()) << i;
    if (!hit) continue;
    ++hits;
    EXPECT_NEAR(spots[i].distance, hit->distance, 1e-5f);
    EXPECT_LT(apart(spots[i].normal, hit->normal), 1e-4f);
  }
  EXPECT_GT(hits, 500);
  EXPECT_LT(hits, 1000);
}

// A square of two by two texels, two of which are holes.
TEST(RenderLeaf, RaysPassThroughTheHolesOfATexture) {
  TreeModel tree;
  tree.images.push_back({2, 2, {0, 255, 0, 255, 0, 0, 0, 0, 0, 0, 0, 0, 255, 0, 0, 255}});
  Material material;
  material.alpha_mode = AlphaMode::mask;
  material.base_color_image = 0;
  tree.materials.push_back(material);
  Primitive square;
  square.material = 0;
  square.positions = {{-1, -1, 0}, {1, -1, 0}, {1, 1, 0}, {-1, 1, 0}};
  square.uvs = {{0, 1}, {1, 1}, {1, 0}, {0, 0}};
  square.triangles = {{0, 1, 2}, {0, 2, 3}};
  tree.primitives.push_back(square);
  tree.instances.push_back({});
  const DeviceHandle embree = open_embree();
  const Scene scene(embree.get(), {make_surface(embree.get(), tree, {}, Look::leaf, Placement{})});
  const MeshTarget target(scene);
  const std::array<const Target*, 1> targets{&target};
  const Camera camera = from_front(2);
  const Buffers buffers = draw(targets, camera, 16, 16, MeshSurroundings(targets));
  const auto at = [&](float x, float y) { return pixel_of(camera, buffers, {x, y, 0}); };
  EXPECT_EQ(buffers.object[at(-0.6f, 0.6f)], Object::foliage);
  EXPECT_EQ(buffers.object[at(0.6f, -0.6f)], Object::foliage);
  EXPECT_EQ(buffers.object[at(0.6f, 0.6f)], Object::paper);
  EXPECT_EQ(buffers.object[at(-0.6f, -0.6f)], Object::paper);
  EXPECT_LT(apart(buffers.color[at(-0.6f, 0.6f)], {0, 1, 0}), 0.01f);
}

TEST(RenderWood, HasTheColoursOfItsVertices) {
  TreeModel tree;
  tree.materials.emplace_back().base_color = {1, 0.5f, 1, 1};
  Primitive square;
  square.material = 0;
  square.positions = {{-1, -1, 0}, {1, -1, 0}, {1, 1, 0}, {-1, 1, 0}};
  square.colors = {{1, 0, 0}, {0, 0, 1}, {0, 0, 1}, {1, 0, 0}};
  square.triangles = {{0, 1, 2}, {0, 2, 3}};
  tree.primitives.push_back(square);
  tree.instances.push_back({});
  const DeviceHandle embree = open_embree();
  const Scene scene(embree.get(), {make_surface(embree.get(), tree, {}, Look::wood, Placement{})});
  const auto seen = [&](float x) { return closest(scene, {{x, 0.3f, 1}, {0, 0, -1}})->color; };
  EXPECT_LT(apart(seen(-0.999f), {1, 0, 0}), 1e-2f);
  EXPECT_LT(apart(seen(0.999f), {0, 0, 1}), 1e-2f);
  EXPECT_LT(apart(seen(0.5f), {0.25f, 0, 0.75f}), 1e-3f);
}

TEST_F(RenderMesh, IsTheSameWithAnyNumberOfThreads) {
  const Camera camera = from_front(3);
  const MeshSurroundings sky(targets_);
  const Buffers many = draw(targets_, camera, 90, 70, sky);
  const tbb::global_control one(tbb::global_control::max_allowed_parallelism, 1);
  const Buffers single = draw(targets_, camera, 90, 70, sky);
  EXPECT_EQ(many.depth, single.depth);
  EXPECT_EQ(many.normal, single.normal);
  EXPECT_EQ(many.key, single.key);
  EXPECT_EQ(many.open, single.open);
  EXPECT_EQ(many.foliage, single.foliage);
  EXPECT_EQ(many.edges, single.edges);
}

}  // namespace
}  // namespace leafhull::render
