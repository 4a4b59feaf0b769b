// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>
#include <tiny_gltf.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <random>
#include <string>
#include <vector>

#include "forest/instances.h"
#include "khronos_validator.h"
#include "leafhull/tree.h"
#include "load_glb.h"
#include "output_sample.h"

namespace leafhull::test {
namespace {

using Matrix = std::array<double, 9>;  // row by row

Vec3d times(const auto& m, Vec3d v) {
  return {m[0] * v.x + m[1] * v.y + m[2] * v.z, m[3] * v.x + m[4] * v.y + m[5] * v.z,
          m[6] * v.x + m[7] * v.y + m[8] * v.z};
}

Matrix times(const Matrix& a, const Matrix& b) {
  Matrix product{};
  for (std::size_t i = 0; i < 9; ++i) {
    for (std::size_t k = 0; k < 3; ++k) product[i] += a[i / 3 * 3 + k] * b[3 * k + i % 3];
  }
  return product;
}

Matrix rotation(Vec3d axis, double angle) {
  const Vec3d u = normalized(axis);
  const double c = std::cos(angle), s = std::sin(angle), t = 1 - c;
  return {t * u.x * u.x + c,       t * u.x * u.y - s * u.z, t * u.x * u.z + s * u.y,
          t * u.x * u.y + s * u.z, t * u.y * u.y + c,       t * u.y * u.z - s * u.x,
          t * u.x * u.z - s * u.y, t * u.y * u.z + s * u.x, t * u.z * u.z + c};
}

Matrix diagonal(Vec3d s) { return {s.x, 0, 0, 0, s.y, 0, 0, 0, s.z}; }

PlacedTree placed(const Matrix& linear, Vec3d position, std::uint32_t model = 0) {
  PlacedTree tree{.position = position, .linear = {}, .model = model};
  std::ranges::transform(linear, tree.linear.begin(),
                         [](double x) { return static_cast<float>(x); });
  return tree;
}

/// Trees with a random rotation and scale, somewhere in a square.
class RandomTrees {
 public:
  PlacedTree next(std::uint32_t model = 0, double width = 200, Vec3d centre = {}) {
    const auto u = [&] { return std::uniform_real_distribution(-1.0, 1.0)(engine_); };
    const Matrix turned = rotation({u(), u(), u()}, 3.2 * u());
    const Matrix scaled = diagonal({1 + 0.5 * u(), 1 + 0.5 * u(), 1 + 0.5 * u()});
    return placed(times(turned, scaled), centre + Vec3d{width / 2 * u(), 10 * u(), width / 2 * u()},
                  model);
  }

 private:
  std::mt19937_64 engine_{7};
};

/// An egg, which looks different after any rotation.
ModelShape egg(const std::string& name, int rings = 6, Vec3d origin = {}) {
  ModelShape shape{name, sphere(rings, origin)};
  for (Vec3f& p : shape.mesh.positions) p = {p.x, 2 * p.y + 0.25f * p.x, 3 * p.z + 1};
  return shape;
}

std::string glb_of(const std::vector<ModelShape>& shapes, const std::vector<PlacedTree>& trees) {
  return written([&](std::ostream& stream) { write_instances(shapes, trees, stream); });
}

template <class Element>
std::vector<Element> elements(const tinygltf::Model& model, int index) {
  const tinygltf::Accessor& accessor = model.accessors.at(static_cast<std::size_t>(index));
  const tinygltf::BufferView& view =
      model.bufferViews.at(static_cast<std::size_t>(accessor.bufferView));
  EXPECT_EQ(accessor.componentType, TINYGLTF_COMPONENT_TYPE_FLOAT);
  EXPECT_EQ(view.byteLength, accessor.count * sizeof(Element));
  std::vector<Element> result(accessor.count);
  std::memcpy(result.data(), model.buffers.at(0).data.data() + view.byteOffset, view.byteLength);
  return result;
}

/// A glTF placement: translation, rotation x y z w, scale.
struct Pose {
  Vec3d t{};
  std::array<double, 4> r{0, 0, 0, 1};
  Vec3d s{1, 1, 1};

  Vec3d operator()(Vec3d v) const {
    const Vec3d scaled{s.x * v.x, s.y * v.y, s.z * v.z}, axis{r[0], r[1], r[2]};
    return t + scaled + 2.0 * cross(axis, cross(axis, scaled) + r[3] * scaled);
  }
};

Pose pose_of(const tinygltf::Node& node) {
  EXPECT_TRUE(node.matrix.empty());
  Pose pose;
  const auto vec = [](const std::vector<double>& v) { return Vec3d{v.at(0), v.at(1), v.at(2)}; };
  if (!node.translation.empty()) pose.t = vec(node.translation);
  if (!node.rotation.empty()) std::ranges::copy(node.rotation, pose.r.begin());
  if (!node.scale.empty()) pose.s = vec(node.scale);
  return pose;
}

/// The vertices of one placed shape.
struct Crown {
  std::string name;
  bool instanced = false;
  std::vector<Vec3d> vertices;
};

/// Every shape that the file shows, node by node, from the roots down.
std::vector<Crown> crowns_of(const tinygltf::Model& model) {
  std::vector<Crown> crowns;
  const auto show = [&](const tinygltf::Node& node, const std::vector<Pose>& poses,
                        bool instanced) {
    const auto& mesh = model.meshes.at(static_cast<std::size_t>(node.mesh));
    EXPECT_EQ(mesh.name, "abstract shape");  // other rooms know shapes by this name
    Crown crown{node.name, instanced, {}};
    for (Vec3f p : elements<Vec3f>(model, mesh.primitives.at(0).attributes.at("POSITION"))) {
      Vec3d at(p);
      for (const Pose& pose : poses) at = pose(at);
      crown.vertices.push_back(at);
    }
    crowns.push_back(std::move(crown));
  };
  const auto visit = [&](const auto& self, int index, std::vector<Pose> poses) -> void {
    const tinygltf::Node& node = model.nodes.at(static_cast<std::size_t>(index));
    poses.insert(poses.begin(), pose_of(node));
    for (const int child : node.children) self(self, child, poses);
    const auto extension = node.extensions.find("EXT_mesh_gpu_instancing");
    if (extension == node.extensions.end()) {
      if (node.mesh >= 0) show(node, poses, false);
      return;
    }
    const tinygltf::Value& attributes = extension->second.Get("attributes");
    const auto accessor = [&](const char* name) { return attributes.Get(name).GetNumberAsInt(); };
    const auto t = elements<Vec3f>(model, accessor("TRANSLATION"));
    const auto r = elements<std::array<float, 4>>(model, accessor("ROTATION"));
    const auto s = elements<Vec3f>(model, accessor("SCALE"));
    ASSERT_EQ(r.size(), t.size());
    ASSERT_EQ(s.size(), t.size());
    for (std::size_t i = 0; i < t.size(); ++i) {
      std::vector<Pose> all{{Vec3d(t[i]), {r[i][0], r[i][1], r[i][2], r[i][3]}, Vec3d(s[i])}};
      all.insert(all.end(), poses.begin(), poses.end());
      show(node, all, true);
    }
  };
  for (const int root : model.scenes.at(0).nodes) visit(visit, root, {});
  return crowns;
}

std::vector<Crown> crowns_of(const std::string& glb) { return crowns_of(load_glb(glb)); }

/// Expects the crown to be that of the tree; `tolerance` is in sizes of the crown.
void expect_crown(const Crown& crown, const PlacedTree& tree, const std::vector<ModelShape>& shapes,
                  double tolerance = 3e-6) {
  const ModelShape& shape = shapes.at(tree.model);
  EXPECT_EQ(crown.name, shape.name);
  ASSERT_EQ(crown.vertices.size(), shape.mesh.positions.size());
  Box box;
  double off = 0;
  for (std::size_t i = 0; i < crown.vertices.size(); ++i) {
    const Vec3d own = shape.mesh.origin + Vec3d(shape.mesh.positions[i]);
    box.include(crown.vertices[i]);
    off = std::max(off, length(crown.vertices[i] - (times(tree.linear, own) + tree.position)));
  }
  EXPECT_LE(off, tolerance * box.longest_side());
}

TEST(Instances, PlaceEachShapeWhereItsTreesStand) {
  const std::vector<ModelShape> shapes{egg("ash"), egg("birch", 9)};
  RandomTrees random;
  std::vector<PlacedTree> trees;
  for (std::uint32_t i = 0; i < 100; ++i) trees.push_back(random.next(i / 3 % 2));
  const tinygltf::Model model = load_glb(glb_of(shapes, trees));
  EXPECT_EQ(model.meshes.size(), 2u);
  EXPECT_EQ(model.extensionsUsed, std::vector<std::string>{"EXT_mesh_gpu_instancing"});
  EXPECT_EQ(model.extensionsRequired, model.extensionsUsed);
  ASSERT_EQ(model.nodes.size(), 2u);
  EXPECT_TRUE(model.nodes[0].translation.empty());

  std::ranges::stable_sort(trees, {}, &PlacedTree::model);  // the order of the file within a node
  const std::vector<Crown> crowns = crowns_of(model);
  ASSERT_EQ(crowns.size(), trees.size());
  for (std::size_t i = 0; i < trees.size(); ++i) expect_crown(crowns[i], trees[i], shapes);
}

TEST(Instances, AreReadAsATreeFile) {
  const TemporaryFolder folder;
  const std::vector<ModelShape> shapes{egg("ash")};
  RandomTrees random;
  std::vector<PlacedTree> trees;
  for (int i = 0; i < 20; ++i) trees.push_back(random.next(0, 200, {1e6 + 0.3, 0, 0}));
  write_file(folder / "forest.glb", glb_of(shapes, trees));
  const TreeModel forest = read_tree(folder / "forest.glb");
  ASSERT_EQ(forest.instances.size(), trees.size());
  for (std::size_t i = 0; i < trees.size(); ++i) {
    const Transform& to_world = forest.instances[i].to_world;
    for (const Vec3f p : forest.primitives.at(0).positions) {
      const Vec3d expected = times(trees[i].linear, Vec3d(p)) + trees[i].position;
      const auto row = [&](std::size_t r) {
        return dot(Vec3d{to_world[r][0], to_world[r][1], to_world[r][2]}, Vec3d(p)) +
               to_world[r][3];
      };
      EXPECT_LT(length(Vec3d{row(0), row(1), row(2)} - expected), 4e-5);
    }
  }
}

TEST(Instances, KeepTheirPlaceFarAway) {
  const std::vector<ModelShape> shapes{egg("ash")};
  RandomTrees random;
  std::vector<PlacedTree> trees;
  for (int i = 0; i < 500; ++i) trees.push_back(random.next(0, 50'000, {1e7 + 0.1, 3e5, -4e6}));
  const tinygltf::Model model = load_glb(glb_of(shapes, trees));
  EXPECT_EQ(model.meshes.size(), 1u);
  EXPECT_GT(model.nodes.size(), 10u);
  std::vector<Crown> crowns = crowns_of(model);
  ASSERT_EQ(crowns.size(), trees.size());
  const auto place = [](const auto& at) { return std::pair(at.x, at.z); };
  std::ranges::sort(trees, {}, [&](const PlacedTree& tree) {
    return place(times(tree.linear, Vec3d(shapes[0].mesh.positions[0])) + tree.position);
  });
  std::ranges::sort(crowns, {}, [&](const Crown& crown) { return place(crown.vertices[0]); });
  for (std::size_t i = 0; i < trees.size(); ++i) expect_crown(crowns[i], trees[i], shapes, 1e-5);
}

TEST(Instances, OfOneModelShareANodeWhereFloatsSuffice) {
  RandomTrees random;
  std::vector<PlacedTree> trees;
  for (int i = 0; i < 10'000; ++i) trees.push_back(random.next(0, 1000));
  EXPECT_EQ(load_glb(glb_of({egg("ash")}, trees)).nodes.size(), 1u);
}

TEST(Instances, TakeAMeshesOriginIntoTheirPlace) {
  const std::vector<ModelShape> shapes{egg("far", 6, {20'000, 0, -1e6})};
  const std::vector<PlacedTree> trees{RandomTrees().next(0, 200, {0, 500, 0})};
  const auto crowns = crowns_of(glb_of(shapes, trees));
  ASSERT_EQ(crowns.size(), 1u);
  expect_crown(crowns[0], trees[0], shapes, 1e-5);
}

TEST(Instances, ThatMirrorAreNodesOfTheirOwn) {
  const std::vector<ModelShape> shapes{egg("ash")};
  const Matrix turned = rotation({1, 2, 3}, 1);
  const std::vector<PlacedTree> trees{placed(turned, {0, 0, 0}),
                                      placed(times(turned, diagonal({1, 1, -2})), {0.1, 7, 1e7}),
                                      placed(diagonal({-1, -1, -1}), {3, 0, 0})};
  const tinygltf::Model model = load_glb(glb_of(shapes, trees));
  ASSERT_EQ(model.nodes.size(), 3u);
  const std::vector<Crown> crowns = crowns_of(model);
  ASSERT_EQ(crowns.size(), 3u);
  for (const std::size_t i : {0u, 1u, 2u}) {
    const Crown& crown = crowns[(i + 2) % 3];  // the instances come last
    EXPECT_EQ(crown.instanced, i == 0);
    expect_crown(crown, trees[i], shapes);
  }
  // Viewers reverse faces if the product of a node's scales is negative.
  EXPECT_LT(model.nodes[0].scale.at(0) * model.nodes[0].scale.at(1) * model.nodes[0].scale.at(2),
            0);
}

TEST(Instances, ThatShearAreARotationInAScale) {
  const std::vector<ModelShape> shapes{egg("ash")};
  std::mt19937_64 engine(3);
  std::uniform_real_distribution<double> u(-1, 1);
  std::vector<PlacedTree> trees{placed({0, 1, 0, 0, 1e-3, 1, 2, 0, 0}, {-4, 5, 6})};
  for (int i = 0; i < 50; ++i) {
    Matrix linear;
    for (double& entry : linear) entry = u(engine);
    trees.push_back(placed(linear, {4, 5, 1e7 + u(engine)}));
  }
  const std::vector<Crown> crowns = crowns_of(glb_of(shapes, trees));
  ASSERT_EQ(crowns.size(), trees.size());
  for (std::size_t i = 0; i < trees.size(); ++i) {
    EXPECT_FALSE(crowns[i].instanced);
    expect_crown(crowns[i], trees[i], shapes);
  }
}

TEST(Instances, OfAModelWithoutASurfaceAreLeftOut) {
  const std::vector<ModelShape> shapes{{"bare", {}}, egg("ash")};
  const std::vector<PlacedTree> trees{placed(diagonal({1, 1, 1}), {}, 0),
                                      placed(diagonal({-1, 1, 1}), {}, 0),
                                      placed(diagonal({1, 1, 1}), {1, 2, 3}, 1)};
  const auto crowns = crowns_of(glb_of(shapes, trees));
  ASSERT_EQ(crowns.size(), 1u);
  expect_crown(crowns[0], trees[2], shapes);
}

TEST(Instances, TakeFortyBytesEach) {
  const std::vector<ModelShape> shapes{egg("ash"), egg("birch")};
  RandomTrees random;
  std::vector<PlacedTree> trees{random.next(), random.next(1)};
  const std::size_t without = glb_of(shapes, trees).size();
  for (std::uint32_t i = 0; i < 50'000; ++i) trees.push_back(random.next(i % 2, 2000));
  EXPECT_LT(glb_of(shapes, trees).size(), without + 40 * 50'000 + 16'000);
}

TEST(Instances, PassTheKhronosValidator) {
  const TemporaryFolder folder;
  RandomTrees random;
  std::vector<PlacedTree> trees;
  for (std::uint32_t i = 0; i < 200; ++i) trees.push_back(random.next(i % 2, 20'000, {1e6, 0, 0}));
  write_file(folder / "forest.glb", glb_of({egg("ash"), egg("birch \"white\"")}, trees));
  trees.push_back(placed(diagonal({1, 1, -1}), {1, 2, 3}));
  trees.push_back(placed({1, 0.5, 0, 0, 1, 0, 0, 0.25, 1}, {4, 5, 6}));
  write_file(folder / "odd.glb", glb_of({egg("ash"), egg("birch")}, trees));
  expect_valid_gltf({folder / "forest.glb", folder / "odd.glb"}, folder / "log");
}

}  // namespace
}  // namespace leafhull::test
