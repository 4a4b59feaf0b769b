// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <fstream>

#include "input/obj.h"
#include "input/polygon.h"
#include "leafhull/error.h"
#include "leafhull/tree.h"
#include "png.h"
#include "temporary_folder.h"

namespace leafhull::test {
namespace {

TreeModel read_lines(const std::string& text) {
  const auto* bytes = reinterpret_cast<const std::uint8_t*>(text.data());
  return read_obj({bytes, text.size()}, "t.obj", Companions("t.obj", false));
}

std::string error_of(const std::string& text) {
  try {
    read_lines(text);
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ErrorCode::input);
    EXPECT_FALSE(error.remedy().empty());
    return error.what();
  }
  return "no error";
}

double area(const std::vector<Vec3d>& polygon) {
  double sum = 0;
  for (const auto& [a, b, c] : triangulate(polygon)) {
    const double twice = cross(polygon[b] - polygon[a], polygon[c] - polygon[a]).z;
    EXPECT_GT(twice, 0);
    sum += twice / 2;
  }
  return sum;
}

TEST(Polygon, CutsConcavePolygonsWhereverTheyLie) {
  for (const Vec3d o : {Vec3d(0, 0, 0), Vec3d(-1e4, 5, 3), Vec3d(7, -1e4, 0)}) {
    const auto at = [&](double x, double y) { return o + Vec3d(x, y, 0); };
    EXPECT_NEAR(area({at(0, 0), at(4, 0), at(4, 4), at(2, 1), at(0, 4)}), 10, 1e-6);  // a notch
    EXPECT_NEAR(area({at(0, 0), at(2, 1), at(4, 0), at(2, 5)}), 8, 1e-6);             // an arrow
    EXPECT_NEAR(area({at(0, 0), at(3, 0), at(3, 1), at(1, 1), at(1, 3), at(0, 3)}), 5, 1e-6);
  }
}

TEST(Polygon, AlwaysGivesTwoTrianglesLessThanCorners) {
  EXPECT_EQ(triangulate(std::vector<Vec3d>(6)).size(), 4u);
  EXPECT_EQ(triangulate(std::vector<Vec3d>{{0, 0, 0}, {1, 1, 0}, {1, 0, 0}, {0, 1, 0}}).size(), 2u);
}

TEST(Polygon, ManyCornersAreQuick) {
  std::vector<Vec3d> comb;
  for (int i = 0; i < 10000; ++i) {
    comb.push_back({double(i), 0, 0});
    comb.push_back({i + 0.5, 100, 0});
  }
  comb.push_back({10000, 0, 0});
  comb.push_back({10000, -1, 0});
  comb.push_back({0, -1, 0});
  std::ranges::reverse(comb);
  EXPECT_NEAR(area(comb), 10000 * 51, 1e-3);
}

TEST(Obj, NamesPartsAndMaterials) {
  const TreeModel tree = read_lines(
      "o birch\nv 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\n"
      "g trunk\nusemtl bark\nf 1 2 3\n"
      "g crown\nusemtl birch leaf\nf 1 2 3 4\nusemtl bark\nf 2 3 4\n");
  ASSERT_EQ(tree.primitives.size(), 3u);
  ASSERT_EQ(tree.instances.size(), 3u);
  EXPECT_EQ(tree.primitives[1].mesh_name, "crown");
  EXPECT_EQ(tree.instances[1].node_name, "birch");
  EXPECT_EQ(tree.materials[std::size_t(tree.primitives[1].material)].name, "birch leaf");
  EXPECT_EQ(tree.primitives[1].triangles.size(), 2u);
  EXPECT_EQ(tree.primitives[1].positions.size(), 4u);
  EXPECT_EQ(tree.primitives[2].material, tree.primitives[0].material);
}

TEST(Obj, KnowsWhatGroupsHangFrom) {
  const TreeModel tree = read_lines(
      "v 0 0 0\nv 1 0 0\nv 1 1 0\no birch\ng trunk\nf 1 2 3\ng crown\nf 1 2 3\n"
      "o ash\nf 1 2 3\n");
  ASSERT_EQ(tree.nodes.size(), 4u);
  const auto path = [&](std::size_t i) {
    std::string text;
    for (int node = tree.instances[i].node; node >= 0; node = tree.nodes[node].parent) {
      text = '/' + tree.nodes[node].name + text;
    }
    return text;
  };
  EXPECT_EQ(path(0), "/birch/trunk");
  EXPECT_EQ(path(1), "/birch/crown");
  EXPECT_EQ(path(2), "/ash");
}

TEST(Obj, ReadsColoursOfVertices) {
  const TreeModel tree = read_lines("v 0 0 0 1 0 0.5\nv 1 0 0 0 0 0\nv 1 1 0 1 1 1\nf 1 2 3\n");
  const std::vector<Vec3f>& colors = tree.primitives[0].colors;
  ASSERT_EQ(colors.size(), 3u);
  EXPECT_EQ(colors[0].x, 1);
  EXPECT_NEAR(colors[0].z, 0.214, 1e-3);  // the file holds sRGB
  EXPECT_EQ(colors[2], Vec3f(1, 1, 1));
  // Only some vertices have a colour, or one is not a colour.
  for (const char* second : {"v 1 0 0", "v 1 0 0 1 2 1", "v 1 0 0 1 nan 0", "v 1 0 0 1 1"}) {
    const std::string text = std::string("v 0 0 0 1 0 0\n") + second + "\nv 1 1 0 1 1 1\nf 1 2 3\n";
    EXPECT_TRUE(read_lines(text).primitives[0].colors.empty()) << second;
  }
}

TEST(Obj, ReadsNormalsUvsAndRelativeIndices) {
  const TreeModel tree = read_lines(
      "v 0 0 0\nv 1 0 0\nv 1 1 0\nvt 0 0.25\nvt 1 0\nvt 1 1\nvn 0 0 1\n"
      "f -3/-3/-1 -2/-2/-1 -1/-1/-1\n");
  const Primitive& p = tree.primitives[0];
  EXPECT_EQ(p.positions, (std::vector<Vec3f>{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}}));
  EXPECT_EQ(p.uvs, (std::vector<Vec2f>{{0, 0.75f}, {1, 1}, {1, 0}}));  // v points down
  EXPECT_EQ(p.normals, std::vector<Vec3f>(3, Vec3f(0, 0, 1)));
  EXPECT_TRUE(read_lines("v 0 0 0\nv 1 0 0\nv 1 1 0\nf 1 2 3\n").primitives[0].uvs.empty());
}

TEST(Obj, ReadsNumbersHoweverTheyAreWritten) {
  const TreeModel tree =
      read_lines("v\t+1 .5  -2.\r  v 1e1 1E+2 1e-1 0.5\r\nv 0 0 0 # last\nf 1 2 3\n");
  EXPECT_EQ(tree.primitives[0].positions, (std::vector<Vec3f>{{1, .5, -2}, {10, 100, .1f}, {}}));
}

TEST(Obj, KeepsValuesThatAreNotFinite) {
  const TreeModel tree = read_lines(
      "v 0 0 0\nv 1 0 0\nv 1 1 0\nvt 0.5\nvt nan 0\nvt 1 1\nvn 0 0 1\nvn 1 x 0\nvn 0 1 0\n"
      "f 1/1/1 2/2/2 3/3/3\n");
  const Primitive& p = tree.primitives[0];
  EXPECT_EQ(p.uvs[0], Vec2f(0.5f, 1));
  EXPECT_TRUE(std::isnan(p.uvs[1].x));
  EXPECT_TRUE(std::isnan(p.normals[1].y));
  EXPECT_EQ(p.normals[2], Vec3f(0, 1, 0));
  EXPECT_EQ(tree.warnings.size(), 2u);
}

TEST(Obj, KeepsItsPrecisionFarFromTheOrigin) {
  const TreeModel tree =
      read_lines("v 10000.0001 0 0\nv 10000.0002 0 0\nv 10000 0.0003 0\nf 1 2 3\n");
  const double origin = tree.instances[0].to_world[0][3];
  const Primitive& p = tree.primitives[0];
  EXPECT_NEAR(origin + p.positions[0].x, 10000.0001, 1e-9);
  EXPECT_NEAR(double(p.positions[1].x) - p.positions[0].x, 1e-4, 1e-9);
}

TEST(Obj, ReadsMaterialLibraryAndMasks) {
  const TemporaryFolder folder;
  const auto write = [&](const std::string& name, const auto& content) {
    std::ofstream(folder / name, std::ios::binary)
        .write(reinterpret_cast<const char*>(content.data()), std::streamsize(content.size()));
  };
  const std::vector<std::uint8_t> color{10, 20, 30, 255}, mask{255, 255, 255, 255, 0, 0, 0, 255};
  write("color.png", png(1, 1, color));
  write("mask.png", png(2, 1, mask));
  write("my tree.mtl", std::string("newmtl leaf\nKd 0.1 0.6 0.2\nmap_Kd color.png\nmap_d mask.png\n"
                                   "newmtl glass\nKd 1 1 1\nd 0.25\n"));
  write("tree.OBJ", std::string("mtllib my tree.mtl\nmtllib lost.mtl\nv 0 0 0\nv 1 0 0\nv 1 1 0\n"
                                "usemtl leaf\nf 1 2 3\nusemtl glass\nf 1 2 3\n"));
  const TreeModel tree = read_tree(folder / "tree.OBJ");
  ASSERT_EQ(tree.warnings.size(), 1u);
  EXPECT_NE(tree.warnings[0].find("lost.mtl"), std::string::npos);
  const Material& leaf = tree.materials[0];
  EXPECT_EQ(leaf.alpha_mode, AlphaMode::mask);
  EXPECT_FLOAT_EQ(leaf.base_color[1], 0.6f);
  ASSERT_EQ(leaf.base_color_image, 0);
  EXPECT_EQ(tree.images[0].rgba, (std::vector<std::uint8_t>{10, 20, 30, 255, 10, 20, 30, 0}));
  EXPECT_EQ(tree.materials[1].alpha_mode, AlphaMode::blend);
  EXPECT_FLOAT_EQ(tree.materials[1].base_color[3], 0.25f);
}

/// A folder with an OBJ file, which has one triangle for each named material, and its libraries.
struct ObjFolder {
  TemporaryFolder folder;

  void write(const std::string& name, const std::string& text) const {
    std::filesystem::create_directories((folder / name).parent_path());
    std::ofstream(folder / name, std::ios::binary) << text;
  }
  /// Writes a row of pixels with these alphas.
  void write_image(const std::string& name, const std::vector<std::uint8_t>& alphas) const {
    std::vector<std::uint8_t> rgba;
    for (const std::uint8_t alpha : alphas) rgba.insert(rgba.end(), {10, 20, 30, alpha});
    const auto file = png(static_cast<int>(alphas.size()), 1, rgba);
    write(name, std::string(file.begin(), file.end()));
  }
  TreeModel read(const std::string& head, const std::vector<std::string>& materials) const {
    std::string text = head + "v 0 0 0\nv 1 0 0\nv 1 1 0\n";
    for (const std::string& material : materials) text += "usemtl " + material + "\nf 1 2 3\n";
    write("t.obj", text);
    return read_tree(folder / "t.obj");
  }
};

const Material& material_named(const TreeModel& tree, const std::string& name) {
  return *std::ranges::find(tree.materials, name, &Material::name);
}

void expect_one_warning(const TreeModel& tree, const std::vector<std::string>& parts) {
  ASSERT_EQ(tree.warnings.size(), 1u);
  for (const std::string& part : parts) {
    EXPECT_NE(tree.warnings[0].find(part), std::string::npos) << tree.warnings[0];
  }
}

TEST(Obj, PassesOverByteOrderMarks) {
  const ObjFolder files;
  files.write("t.mtl", "\xEF\xBB\xBFnewmtl leaf\r\nKd 0 0.5 0\r\n");
  const TreeModel tree = files.read("\xEF\xBB\xBFmtllib t.mtl\r\n", {"leaf"});
  EXPECT_FLOAT_EQ(material_named(tree, "leaf").base_color[1], 0.5f);
  EXPECT_TRUE(tree.warnings.empty());
}

TEST(Obj, KnowsKeywordsInAnyCase) {
  const ObjFolder files;
  files.write_image("leaf.png", {255, 0});
  files.write("t.mtl", "NewMtl leaf\nKD 0 .5 0\nMAP_KD leaf.png\nmap_D leaf.png\n\tTR 0.5\n");
  files.write("u.obj",
              "MtlLib t.mtl\nV 0 0 0\nV 1 0 0\nV 1 1 0\nVT 0 0\nVN 0 0 1\nG crown\n"
              "UseMTL leaf\nF 1/1/1 2/1/1 3/1/1\n");
  const TreeModel tree = read_tree(files.folder / "u.obj");
  EXPECT_TRUE(tree.warnings.empty());
  EXPECT_EQ(tree.primitives[0].mesh_name, "crown");
  EXPECT_EQ(tree.primitives[0].uvs.size(), 3u);
  const Material& leaf = material_named(tree, "leaf");
  EXPECT_EQ(leaf.alpha_mode, AlphaMode::mask);
  EXPECT_EQ(leaf.base_color, (std::array<float, 4>{0, 0.5f, 0, 0.5f}));
  EXPECT_EQ(tree.images.at(0).rgba[7], 0);
}

TEST(Obj, JoinsContinuedLines) {
  for (const std::string end : {"\n", "\r\n", "\r"}) {
    std::string text =
        "# C:\\trees\\\nv 0 0 0\nv 1\\\n 0 \\\n0\nv 1 1 0\nv 0 1 0\nf 1 2\\\n3 4\nv nan 0 0\\";
    for (std::size_t at = 0; (at = text.find('\n', at)) != std::string::npos; at += end.size()) {
      text.replace(at, 1, end);
    }
    EXPECT_NE(error_of(text).find("line 10: "), std::string::npos) << error_of(text);
    const TreeModel tree = read_lines(text.substr(0, text.find("v nan")));
    EXPECT_EQ(tree.primitives.at(0).triangles.size(), 2u);
    EXPECT_EQ(std::ranges::count(tree.primitives[0].positions, Vec3f(1, 0, 0)), 1);
  }
}

TEST(Obj, TakesHolesOfTheColourImage) {
  const ObjFolder files;
  files.write_image("holes.png", {255, 0});
  files.write_image("full.png", {255, 254});
  files.write_image("nothing.png", {0, 0});
  files.write("t.mtl",
              "newmtl leaf\nmap_Kd holes.png\nnewmtl same\nmap_Kd holes.png\n"
              "newmtl bark\nmap_Kd full.png\nnewmtl pond\nd 0.5\nmap_Kd holes.png\n");
  const TreeModel tree = files.read("mtllib t.mtl\n", {"leaf", "same", "bark", "pond"});
  EXPECT_TRUE(tree.warnings.empty());
  EXPECT_EQ(material_named(tree, "leaf").alpha_mode, AlphaMode::mask);
  EXPECT_EQ(material_named(tree, "same").alpha_mode, AlphaMode::mask);
  EXPECT_EQ(material_named(tree, "bark").alpha_mode, AlphaMode::opaque);
  EXPECT_EQ(material_named(tree, "pond").alpha_mode, AlphaMode::blend);
  EXPECT_EQ(material_named(tree, "leaf").base_color[1], 1) << "no Kd beside a texture";

  files.write("t.mtl", "newmtl leaf\nmap_Kd nothing.png\n");
  const TreeModel empty = files.read("mtllib t.mtl\n", {"leaf"});
  EXPECT_EQ(empty.materials[0].alpha_mode, AlphaMode::opaque);
  expect_one_warning(empty, {"nothing.png", "passed over"});
}

TEST(Obj, FindsTexturesOfAnotherMachine) {
  const ObjFolder files;
  files.write_image("Textures/Leaf.PNG", {255, 0});
  files.write("t.mtl", "newmtl leaf\nmap_Kd C:\\Users\\Ann\\textures\\leaf.png\n");
  const TreeModel tree = files.read("mtllib t.mtl\n", {"leaf"});
  EXPECT_EQ(tree.images.at(0).width, 2);
  expect_one_warning(tree, {"\"C:\\Users\\Ann\\textures\\leaf.png\"", "Textures/Leaf.PNG"});
}

TEST(Obj, ReadsSeveralLibrariesOfOneLine) {
  const ObjFolder files;
  files.write("my a.mtl", "newmtl a\nKd 0 0 0\n");
  files.write("b.MTL", "newmtl b\nKd 0 0 0\n");
  const TreeModel tree = files.read("mtllib my a.mtl b.MTL\nmtllib b.MTL\n", {"a", "b"});
  EXPECT_TRUE(tree.warnings.empty());
  EXPECT_EQ(tree.materials.size(), 2u);
  EXPECT_EQ(material_named(tree, "a").base_color[0], 0);
  EXPECT_EQ(material_named(tree, "b").base_color[0], 0);

  expect_one_warning(files.read("mtllib ./lost.mtl ./b.MTL\n", {"b"}), {"lost.mtl\" not read"});
  expect_one_warning(files.read("mtllib a lost one.mtl\n", {"b"}), {"\"a lost one.mtl\" not read"});

  files.write("c.mtl d.mtl", "newmtl c\nKd 0 0 0\n");
  const TreeModel one = files.read("mtllib c.mtl d.mtl\n", {"c"});
  EXPECT_TRUE(one.warnings.empty());
  EXPECT_EQ(one.materials.size(), 1u);
}

TEST(Obj, TakesOpacitiesThatCannotBeMeantAsOpaque) {
  const ObjFolder files;
  files.write_image("mask.png", {255, 0});
  const auto read = [&](const std::string& library, const std::vector<std::string>& materials) {
    files.write("t.mtl", library);
    return files.read("mtllib t.mtl\n", materials);
  };
  const std::vector<std::string> both{"a", "b"};

  const TreeModel tree =
      read("newmtl a\nd 0.25\nTr 0.75\nnewmtl b\nTr 0.75\nnewmtl c\nd -halo 0.5\nnewmtl e\nd 0\n",
           {"a", "b", "c", "e"});
  EXPECT_TRUE(tree.warnings.empty());
  for (const char* name : {"a", "b"}) {
    EXPECT_FLOAT_EQ(material_named(tree, name).base_color[3], 0.25f);
  }
  EXPECT_FLOAT_EQ(material_named(tree, "c").base_color[3], 0.5f);
  EXPECT_FLOAT_EQ(material_named(tree, "e").base_color[3], 0);

  for (const char* all : {"newmtl a\nd 0\nnewmtl b\nd 0.0\n", "newmtl a\nTr 1\nnewmtl b\nTr 1\n",
                          "newmtl a\nd 0\nTr 1\nnewmtl b\nTr 1\n"}) {
    const TreeModel opaque = read(all, both);
    expect_one_warning(opaque, {"\"t.mtl\": ", "every material fully transparent"});
    EXPECT_EQ(opaque.materials[1].alpha_mode, AlphaMode::opaque);
    EXPECT_EQ(opaque.materials[1].base_color[3], 1);
  }
  for (const char* at_odds : {"Tr 1\nd 1", "d 1\nTr 1", "d 0\nTr 0", "d 0\nmap_d mask.png"}) {
    const TreeModel opaque =
        read(std::string("newmtl b\nd 0.5\nnewmtl a\n") + at_odds + "\n", both);
    expect_one_warning(opaque, {"contradict each other", "opaque: \"a\""});
    EXPECT_EQ(material_named(opaque, "a").base_color[3], 1);
  }
}

TEST(Obj, SaysWhatIsNoFace) {
  const TreeModel tree =
      read_lines("v 0 0 0\nv 1 0 0\nv 0 1 0\nl 1 2\np 3\ncurv 0 1 1 2\nf 1 2 3\n");
  EXPECT_EQ(tree.warnings, std::vector<std::string>{"3 points, lines or curves are passed over"});
}

TEST(Obj, NamesMaterialsThatNoLibraryHas) {
  const ObjFolder files;
  files.write("t.mtl", "newmtl leaf\nKd 0 0 0\n");
  expect_one_warning(files.read("mtllib t.mtl\n", {"leaf", "bark", "a", "b", "c", "bark"}),
                     {"no material library has \"bark\", \"a\", \"b\" and 1 more"});
  EXPECT_TRUE(files.read("", {"bark"}).warnings.empty());
  expect_one_warning(files.read("mtllib lost.mtl\n", {"bark"}), {"lost.mtl"});
}

TEST(Obj, RefusesBadFiles) {
  const std::string vertices = "v 0 0 0\nv 1 0 0\nv 1 1 0\n";
  EXPECT_NE(error_of(vertices + "f 1 2 4\n").find("t.obj: "), std::string::npos);
  EXPECT_NE(error_of(vertices + "f 1 2 4\n").find("past the vertices"), std::string::npos);
  EXPECT_NE(error_of(vertices + "f 1/9 2/9 3/9\n").find("past the vertices"), std::string::npos);
  EXPECT_NE(error_of(vertices + "f 1 2 -4\n").find("index -4"), std::string::npos);
  EXPECT_NE(error_of(vertices + "f 0 1 2\n").find("face 1: index 0"), std::string::npos);
  EXPECT_NE(error_of("v 0 0 0\nv nan 0 0\n").find("line 2"), std::string::npos);
  for (const char* line : {"v\tnan 1 2", "  v nan 1 2", "v 1e 2 3", "v --1 2 3", "v +-1 2 3",
                           "v 1.0.0 2 3", "v 1 2 inf", "v 1 2 1e999", "v 1", "v", "v 1,5 2 3"}) {
    for (const char* end : {"\n", "\r\n", "\r"}) {
      const std::string text = std::string("v 0 0 0") + end + line + end;
      EXPECT_NE(error_of(text).find("t.obj: line 2: "), std::string::npos) << line;
    }
  }
  EXPECT_NE(error_of("v 0 0 1e60\n" + vertices + "f 1 2 3\n").find("vertex 1"), std::string::npos);
  EXPECT_NE(error_of(vertices).find("holds no faces"), std::string::npos);
  EXPECT_NE(error_of("hello").find("holds no faces"), std::string::npos);
  EXPECT_NE(error_of("\xFF\xFEv").find("is UTF-16 text"), std::string::npos);
}

}  // namespace
}  // namespace leafhull::test
