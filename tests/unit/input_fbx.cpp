// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <fstream>

#include "colour/colour.h"
#include "fbx_builder.h"
#include "input/fbx.h"
#include "leafhull/error.h"
#include "leafhull/tree.h"
#include "png.h"
#include "temporary_folder.h"

namespace leafhull::test {
namespace {

#ifdef LEAFHULL_HAS_FBX

constexpr std::int64_t kFbxMesh = 10, kFbxModel = 20, kFbxMaterial = 30, kFbxTexture = 40;

TreeModel read_fbx_text(const std::string& text, const Companions& companions = {},
                        Axes axes = Axes::as_it_says) {
  const auto* bytes = reinterpret_cast<const std::uint8_t*>(text.data());
  return read_fbx({bytes, text.size()}, "t.fbx", companions, axes);
}

FbxRecord fbx_layer(const std::string& kind, const std::string& values, std::vector<double> data,
                    const std::string& mapping = "ByPolygonVertex") {
  return {"LayerElement" + kind,
          {0},
          {{"Version", {101}},
           {"Name", {std::string("first")}},
           {"MappingInformationType", {mapping}},
           {"ReferenceInformationType", {std::string("Direct")}},
           {values, {std::move(data)}}}};
}

/// Adds one quad: a square of side 2 around the origin in the x, y plane, facing +z.
FbxRecord& add_fbx_square(FbxBuilder& file, std::int64_t id = kFbxMesh,
                          const std::string& name = "Square") {
  return file.object(id, "Geometry", name, "Mesh",
                     {{"Vertices", {std::vector<double>{-1, -1, 0, 1, -1, 0, 1, 1, 0, -1, 1, 0}}},
                      {"PolygonVertexIndex", {std::vector<std::int32_t>{0, 1, 2, -4}}},
                      fbx_layer("UV", "UV", {0, 0, 1, 0, 1, 1, 0, 1}),
                      fbx_layer("Normal", "Normals", {0, 0, 1, 0, 0, 1, 0, 0, 1, 0, 0, 1})});
}

void add_fbx_model(FbxBuilder& file, std::int64_t id, const std::string& name,
                   std::vector<FbxRecord> list = {}, std::int64_t parent = 0) {
  file.object(id, "Model", name, "Mesh", {properties(std::move(list))});
  file.connect(id, parent);
}

void add_fbx_material(FbxBuilder& file, std::int64_t id, const std::string& name,
                      std::vector<FbxRecord> list = {}) {
  file.object(id, "Material", name, "",
              {{"ShadingModel", {std::string("phong")}}, properties(std::move(list))});
  file.connect(id, kFbxModel);
}

void add_fbx_texture(FbxBuilder& file, std::int64_t id, const std::string& path,
                     const std::string& property_name) {
  file.object(id, "Texture", "map" + std::to_string(id), "",
              {{"Type", {std::string("TextureVideoClip")}},
               {"FileName", {path}},
               {"RelativeFilename", {path}}});
  file.connect(id, kFbxMaterial, property_name);
}

/// That square in metres, as a leaf "Square" under a node "Leaf".
FbxBuilder fbx_square() {
  FbxBuilder file;
  file.settings = {property("UnitScaleFactor", "double", {100})};
  add_fbx_square(file);
  add_fbx_model(file, kFbxModel, "Leaf");
  file.connect(kFbxMesh, kFbxModel);
  return file;
}

std::vector<Vec3d> fbx_world(const TreeModel& tree, std::size_t instance = 0) {
  const Instance& placed = tree.instances.at(instance);
  std::vector<Vec3d> points;
  for (const Vec3f p : tree.primitives[placed.primitive].positions) {
    const auto row = [&](int i) {
      const auto& r = placed.to_world[i];
      return r[0] * p.x + r[1] * p.y + r[2] * p.z + r[3];
    };
    points.push_back({row(0), row(1), row(2)});
  }
  return points;
}

Box fbx_box(const std::vector<Vec3d>& points) {
  Box box;
  for (const Vec3d p : points) box.include(p);
  return box;
}

void expect_fbx_near(Vec3d a, Vec3d b) {
  EXPECT_LT(length(a - b), 1e-6) << a.x << ' ' << a.y << ' ' << a.z;
}

std::vector<std::uint8_t> two_texels(std::uint8_t red, std::uint8_t alpha) {
  return {red, 0, 0, 255, red, 0, 0, alpha};
}

void write_two_texels(const std::filesystem::path& file, const std::vector<std::uint8_t>& rgba) {
  const std::vector<std::uint8_t> bytes = png(2, 1, rgba);
  std::ofstream(file, std::ios::binary)
      .write(reinterpret_cast<const char*>(bytes.data()),
             static_cast<std::streamsize>(bytes.size()));
}

TEST(Fbx, IsTheSameAsTextAndBinary) {
  const FbxBuilder file = fbx_square();
  for (const std::string& text : {file.ascii(), file.binary()}) {
    const TreeModel tree = read_fbx_text(text);
    ASSERT_EQ(tree.primitives.size(), 1u);
    const Primitive& primitive = tree.primitives[0];
    EXPECT_EQ(primitive.mesh_name, "Square");
    EXPECT_EQ(tree.instances[0].node_name, "Leaf");
    EXPECT_EQ(tree.nodes[tree.instances[0].node].name, "Leaf");
    EXPECT_EQ(primitive.triangles.size(), 2u);
    ASSERT_EQ(primitive.positions.size(), 4u);
    EXPECT_EQ(primitive.normals[0], Vec3f(0, 0, 1));
    for (std::size_t i = 0; i < 4; ++i) {  // v points down
      EXPECT_EQ(primitive.uvs[i].y, primitive.positions[i].y > 0 ? 0 : 1);
    }
    EXPECT_TRUE(tree.warnings.empty()) << tree.warnings[0];
  }
}

TEST(Fbx, IsFoundByItsBytes) {
  const TemporaryFolder folder;
  for (const std::string& text : {fbx_square().ascii(), fbx_square().binary()}) {
    std::ofstream(folder / "tree.bin", std::ios::binary) << text;
    EXPECT_EQ(read_tree(folder / "tree.bin").instances.size(), 1u);
  }
}

TEST(Fbx, IsInMetresAndStandsUp) {
  FbxBuilder file = fbx_square();
  expect_fbx_near(fbx_box(fbx_world(read_fbx_text(file.ascii()))).high, {1, 1, 0});
  file.settings = {property("UnitScaleFactor", "double", {1}),  // centimetres
                   property("UpAxis", "int", {2}),
                   property("UpAxisSign", "int", {1}),
                   property("FrontAxis", "int", {1}),
                   property("FrontAxisSign", "int", {-1}),
                   property("CoordAxis", "int", {0}),
                   property("CoordAxisSign", "int", {1})};
  // The file's y is the world's -z.
  const Box box = fbx_box(fbx_world(read_fbx_text(file.ascii())));
  expect_fbx_near(box.low, {-0.01, 0, -0.01});
  expect_fbx_near(box.high, {0.01, 0, 0.01});
  expect_fbx_near(fbx_box(fbx_world(read_fbx_text(file.ascii(), {}, Axes::as_they_are))).high,
                  {0.01, 0.01, 0});
}

TEST(Fbx, UpOverridesWhatItSays) {
  const TemporaryFolder folder;
  std::ofstream(folder / "t.fbx") << fbx_square().ascii();  // y is up
  ReadOptions options;
  options.up = Up::z;
  expect_fbx_near(fbx_box(fbx_world(read_tree(folder / "t.fbx", options))).high, {1, 0, 1});
}

TEST(Fbx, TransformsGeometryAndPivots) {
  FbxBuilder file;
  file.settings = {property("UnitScaleFactor", "double", {100})};
  add_fbx_square(file);
  add_fbx_model(file, kFbxModel, "Leaf",
                {property("Lcl Translation", "Lcl Translation", {10, 0, 0}),
                 property("Lcl Rotation", "Lcl Rotation", {0, 0, 90}),
                 property("RotationPivot", "Vector3D", {1, 0, 0}),
                 property("GeometricTranslation", "Vector3D", {0, 0, 5}),
                 property("GeometricScaling", "Vector3D", {2, 1, 1})});
  file.connect(kFbxMesh, kFbxModel);
  // (x, y) -> (2x, y), then a quarter turn about (1, 0), then 10 to the right.
  const Box box = fbx_box(fbx_world(read_fbx_text(file.binary())));
  expect_fbx_near(box.low, {10, -3, 5});
  expect_fbx_near(box.high, {12, 1, 5});
}

TEST(Fbx, InstancesShareAPrimitive) {
  FbxBuilder file = fbx_square();
  add_fbx_model(file, kFbxModel + 1, "Other",
                {property("Lcl Translation", "Lcl Translation", {0, 7, 0})});
  file.connect(kFbxMesh, kFbxModel + 1);
  const TreeModel tree = read_fbx_text(file.ascii());
  EXPECT_EQ(tree.primitives.size(), 1u);
  ASSERT_EQ(tree.instances.size(), 2u);
  expect_fbx_near(fbx_box(fbx_world(tree, 1)).high, {1, 8, 0});
}

TEST(Fbx, SeveralMaterialsAMeshAreSeveralPrimitives) {
  FbxBuilder file;
  file.object(
      kFbxMesh, "Geometry", "Tree", "Mesh",
      {{"Vertices", {std::vector<double>{0, 0, 0, 1, 0, 0, 0, 1, 0, 5, 0, 0, 6, 0, 0, 5, 1, 0}}},
       {"PolygonVertexIndex", {std::vector<std::int32_t>{0, 1, -3, 3, 4, -6}}},
       {"LayerElementMaterial",
        {0},
        {{"MappingInformationType", {std::string("ByPolygon")}},
         {"ReferenceInformationType", {std::string("IndexToDirect")}},
         {"Materials", {std::vector<std::int32_t>{0, 1}}}}}});
  add_fbx_model(file, kFbxModel, "Tree");
  file.connect(kFbxMesh, kFbxModel);
  add_fbx_material(file, kFbxMaterial, "Bark",
                   {property("DiffuseColor", "Color", {0.2, 0.1, 0.05})});
  add_fbx_material(file, kFbxMaterial + 1, "Leaf",
                   {property("DiffuseColor", "Color", {0.1, 0.3, 0.05})});
  for (const std::string& text : {file.ascii(), file.binary()}) {
    const TreeModel tree = read_fbx_text(text);
    ASSERT_EQ(tree.primitives.size(), 2u);
    EXPECT_EQ(tree.materials[tree.primitives[0].material].name, "Bark");
    const Material& leaf = tree.materials[tree.primitives[1].material];
    EXPECT_EQ(leaf.name, "Leaf");
    EXPECT_NEAR(leaf.base_color[1], 0.3, 1e-6);
    EXPECT_EQ(leaf.alpha_mode, AlphaMode::opaque);
    EXPECT_EQ(tree.primitives[1].positions[0], Vec3f(5, 0, 0));
  }
}

TEST(Fbx, TexturesOfOtherMachinesAreFoundBesideIt) {
  const TemporaryFolder folder;
  std::filesystem::create_directory(folder / "textures");
  write_two_texels(folder.path() / "textures" / "leaf.png", two_texels(200, 0));
  FbxBuilder file = fbx_square();
  add_fbx_material(file, kFbxMaterial, "Leaf",
                   {property("DiffuseColor", "Color", {0.8, 0.8, 0.8})});
  add_fbx_texture(file, kFbxTexture, "C:\\\\art\\\\LEAF.png", "DiffuseColor");
  const TreeModel tree = read_fbx_text(file.ascii(), Companions(folder / "t.fbx", false));
  ASSERT_EQ(tree.images.size(), 1u);
  EXPECT_EQ(tree.images[0].width, 2);
  const Material& leaf = tree.materials[0];
  EXPECT_EQ(leaf.base_color[0], 1) << "a texture stands in the colour's place";
  EXPECT_EQ(leaf.alpha_mode, AlphaMode::mask) << "its image has holes";
  ASSERT_EQ(tree.warnings.size(), 1u);
  EXPECT_NE(tree.warnings[0].find("own folder"), std::string::npos) << tree.warnings[0];
}

TEST(Fbx, ColoursAreWithinZeroAndOne) {
  FbxBuilder file;
  add_fbx_square(file).children.push_back(
      fbx_layer("Color", "Colors", {1e300, -5, 0, 1, 1, 0, 0, 1, 1, 0, 0, 1, 1, 0, 0, 1}));
  add_fbx_model(file, kFbxModel, "Leaf");
  file.connect(kFbxMesh, kFbxModel);
  add_fbx_material(file, kFbxMaterial, "Leaf",
                   {property("DiffuseColor", "Color", {1e300, -1, 0.5})});
  const TreeModel tree = read_fbx_text(file.ascii());
  for (const Vec3f colour : tree.primitives[0].colors) {
    EXPECT_LE(colour.x, 1);
    EXPECT_GE(colour.y, 0);
  }
  EXPECT_EQ(tree.materials[0].base_color, (std::array<float, 4>{1, 0, 0.5f, 1}));
}

TEST(Fbx, OpacityMayHaveATextureOfItsOwn) {
  const TemporaryFolder folder;
  write_two_texels(folder / "colour.png", two_texels(90, 255));
  const std::vector<std::uint8_t> grey{255, 255, 255, 255, 0, 0, 0, 255};
  write_two_texels(folder / "opacity.png", grey);
  FbxBuilder file = fbx_square();
  add_fbx_material(file, kFbxMaterial, "Leaf");
  add_fbx_texture(file, kFbxTexture, "colour.png", "DiffuseColor");
  add_fbx_texture(file, kFbxTexture + 1, "opacity.png", "TransparentColor");
  const TreeModel tree = read_fbx_text(file.binary(), Companions(folder / "t.fbx", false));
  ASSERT_EQ(tree.images.size(), 1u);
  EXPECT_EQ(tree.images[0].rgba, (std::vector<std::uint8_t>{90, 0, 0, 255, 90, 0, 0, 0}));
  EXPECT_EQ(tree.materials[0].alpha_mode, AlphaMode::mask);
}

TEST(Fbx, ALostTextureIsSaid) {
  FbxBuilder file = fbx_square();
  add_fbx_material(file, kFbxMaterial, "Leaf");
  add_fbx_texture(file, kFbxTexture, "lost.png", "DiffuseColor");
  const TemporaryFolder folder;
  const TreeModel tree = read_fbx_text(file.ascii(), Companions(folder / "t.fbx", false));
  ASSERT_EQ(tree.warnings.size(), 1u);
  EXPECT_NE(tree.warnings[0].find("\"lost.png\": texture not read"), std::string::npos);
}

TEST(Fbx, VertexColoursPaintWhatHasNoTexture) {
  FbxBuilder file;
  add_fbx_square(file).children.push_back(
      fbx_layer("Color", "Colors", {1, 0, 0, 1, 1, 0, 0, 1, 1, 0, 0, 1, 0.5, 0, 0, 1}));
  add_fbx_model(file, kFbxModel, "Leaf");
  file.connect(kFbxMesh, kFbxModel);
  add_fbx_material(file, kFbxMaterial, "Leaf");
  const TreeModel painted = read_fbx_text(file.ascii());
  ASSERT_EQ(painted.primitives[0].colors.size(), 4u);
  const auto least = std::ranges::min_element(painted.primitives[0].colors, {}, &Vec3f::x);
  EXPECT_NEAR(least->x, linear_of_srgb(0.5), 1e-6);
  add_fbx_texture(file, kFbxTexture, "lost.png", "DiffuseColor");
  EXPECT_TRUE(read_fbx_text(file.ascii()).primitives[0].colors.empty());
}

TEST(Fbx, LodGroupsTellTheirLevels) {
  FbxBuilder file;
  constexpr std::int64_t kGroup = 50, kAttribute = 51;
  file.object(kAttribute, "NodeAttribute", "Lods", "LodGroup");
  file.object(kGroup, "Model", "Lods", "LodGroup");
  file.connect(kGroup, 0);
  file.connect(kAttribute, kGroup);
  for (std::int64_t level = 0; level < 2; ++level) {
    add_fbx_square(file, kFbxMesh + level, "m" + std::to_string(level));
    add_fbx_model(file, kFbxModel + level, level == 0 ? "fine" : "coarse", {}, kGroup);
    file.connect(kFbxMesh + level, kFbxModel + level);
  }
  const TreeModel tree = read_fbx_text(file.ascii());
  ASSERT_EQ(tree.instances.size(), 2u);
  EXPECT_EQ(tree.nodes[tree.instances[0].node].level, 0);
  EXPECT_EQ(tree.nodes[tree.instances[1].node].level, 1);
}

TEST(Fbx, JointsPoseASkin) {
  FbxBuilder file = fbx_square();
  constexpr std::int64_t kBone = 60, kSkin = 61, kCluster = 62, kBoneAttribute = 63;
  file.object(kBoneAttribute, "NodeAttribute", "Bone", "LimbNode");
  file.object(kBone, "Model", "Bone", "LimbNode",
              {properties({property("Lcl Translation", "Lcl Translation", {0, 0, 4})})});
  file.connect(kBone, 0);
  file.connect(kBoneAttribute, kBone);
  file.object(kSkin, "Deformer", "Skin", "Skin");
  const std::vector<double> identity{1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1};
  file.object(kCluster, "Deformer", "Cluster", "Cluster",
              {{"Indexes", {std::vector<std::int32_t>{0, 1, 2, 3}}},
               {"Weights", {std::vector<double>{1, 1, 1, 1}}},
               {"Transform", {identity}},
               {"TransformLink", {identity}}});
  file.connect(kSkin, kFbxMesh);
  file.connect(kCluster, kSkin);
  file.connect(kBone, kCluster);
  const Box box = fbx_box(fbx_world(read_fbx_text(file.ascii())));
  expect_fbx_near(box.low, {-1, -1, 4});
  expect_fbx_near(box.high, {1, 1, 4});
}

TEST(Fbx, HiddenNodesStayOut) {
  FbxBuilder file = fbx_square();
  add_fbx_square(file, kFbxMesh + 1, "Hull");
  add_fbx_model(file, kFbxModel + 1, "Hidden", {property("Visibility", "Visibility", {0})});
  file.connect(kFbxMesh + 1, kFbxModel + 1);
  const TreeModel tree = read_fbx_text(file.ascii());
  EXPECT_EQ(tree.instances.size(), 1u);
  ASSERT_EQ(tree.warnings.size(), 1u);
  EXPECT_EQ(tree.warnings[0], "1 hidden mesh is passed over");
}

TEST(Fbx, ThatIsDamagedIsAnError) {
  const auto expect_input_error = [](const std::string& text) {
    try {
      read_fbx_text(text);
      ADD_FAILURE() << "no error";
    } catch (const Error& error) {
      EXPECT_EQ(error.code(), ErrorCode::input) << error.what();
      EXPECT_EQ(std::string(error.what()).rfind("t.fbx: ", 0), 0u) << error.what();
      EXPECT_FALSE(error.remedy().empty());
    }
  };
  const std::string binary = fbx_square().binary(), ascii = fbx_square().ascii();
  for (const std::size_t part : {2, 3, 5}) {
    expect_input_error(binary.substr(0, binary.size() / part));
  }
  expect_input_error("; FBX 7.4.0 project file\nObjects: {");
  expect_input_error("Kaydara FBX Binary  ");
  FbxBuilder no_mesh;
  expect_input_error(no_mesh.ascii());
  FbxBuilder infinite = fbx_square();
  infinite.objects[0].children[0].values = {
      std::vector<double>{1e300, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0}};
  expect_input_error(infinite.binary());
}

#else

TEST(Fbx, IsRefusedWithTheNextStep) {
  try {
    read_fbx({}, "t.fbx", {}, Axes::as_it_says);
    ADD_FAILURE() << "no error";
  } catch (const Error& error) {
    EXPECT_NE(std::string(error.what()).find("without ufbx"), std::string::npos);
    EXPECT_NE(error.remedy().find("Blender"), std::string::npos);
  }
}

#endif

}  // namespace
}  // namespace leafhull::test
