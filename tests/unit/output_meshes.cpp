// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>
#include <tiny_obj_loader.h>

#include "leafhull/output.h"
#include "output/writers.h"
#include "output_sample.h"

namespace leafhull::test {
namespace {

const Vec3d kFarOut{10'000.25, -3, 1e6};

struct ObjFile {
  tinyobj::attrib_t attributes;
  std::vector<tinyobj::shape_t> shapes;
};

ObjFile read_obj(const std::string& text) {
  ObjFile file;
  std::vector<tinyobj::material_t> materials;
  std::string warning, error;
  std::istringstream stream(text);
  EXPECT_TRUE(tinyobj::LoadObj(&file.attributes, &file.shapes, &materials, &warning, &error,
                               &stream, nullptr, /*triangulate=*/false));
  EXPECT_EQ(warning + error, "");
  return file;
}

TEST(Obj, HoldsTheMesh) {
  const Mesh mesh = sphere(6);
  const ObjFile file = read_obj(written([&](std::ostream& stream) { write_obj(mesh, stream); }));
  const auto& [attributes, shapes] = file;
  ASSERT_EQ(attributes.vertices.size(), 3 * mesh.positions.size());
  ASSERT_EQ(attributes.normals.size(), 3 * mesh.normals.size());
  for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
    EXPECT_FLOAT_EQ(attributes.vertices[3 * i], mesh.positions[i].x);
    EXPECT_FLOAT_EQ(attributes.vertices[3 * i + 1], mesh.positions[i].y);
    EXPECT_FLOAT_EQ(attributes.vertices[3 * i + 2], mesh.positions[i].z);
    EXPECT_NEAR(attributes.normals[3 * i + 2], mesh.positions[i].z / 2, 1e-6);
  }
  ASSERT_EQ(shapes.size(), 1u);
  ASSERT_EQ(shapes[0].mesh.indices.size(), 3 * mesh.triangles.size());
  for (std::size_t i = 0; i < 3 * mesh.triangles.size(); ++i) {
    const int vertex = static_cast<int>(mesh.triangles[i / 3][i % 3]);
    EXPECT_EQ(shapes[0].mesh.indices[i].vertex_index, vertex);
    EXPECT_EQ(shapes[0].mesh.indices[i].normal_index, vertex);
    EXPECT_EQ(shapes[0].mesh.indices[i].texcoord_index, -1);
  }
}

template <class Real>
void expect_exact_positions(const Mesh& mesh) {
  std::istringstream text(written([&](std::ostream& stream) { write_obj(mesh, stream); }));
  std::size_t vertex = 0;
  for (std::string line; std::getline(text, line);) {
    if (!line.starts_with("v ")) continue;
    Vec3<Real> position;
    std::istringstream(line.substr(2)) >> position.x >> position.y >> position.z;
    EXPECT_EQ(position, Vec3<Real>(mesh.origin + Vec3d(mesh.positions.at(vertex)))) << line;
    ++vertex;
  }
  EXPECT_EQ(vertex, mesh.positions.size());
}

TEST(Obj, LosesNoDigit) {
  expect_exact_positions<float>(sphere(6));
  expect_exact_positions<double>(sphere(6, kFarOut));
}

struct PlyFile {
  std::vector<std::string> header;
  std::string body;
};

PlyFile read_ply(const std::string& bytes) {
  PlyFile file;
  const std::size_t end = bytes.find("end_header\n");
  EXPECT_NE(end, std::string::npos);
  std::istringstream header(bytes.substr(0, end));
  for (std::string line; std::getline(header, line);) {
    if (!line.starts_with("comment")) file.header.push_back(line);
  }
  file.body = bytes.substr(end + std::string("end_header\n").size());
  return file;
}

template <class Real>
void expect_ply(const Mesh& mesh, const std::string& real) {
  const auto [header, body] =
      read_ply(written([&](std::ostream& stream) { write_ply(mesh, stream); }));
  EXPECT_EQ(header,
            (std::vector<std::string>{"ply", "format binary_little_endian 1.0",
                                      "element vertex " + std::to_string(mesh.positions.size()),
                                      "property " + real + " x", "property " + real + " y",
                                      "property " + real + " z", "property float nx",
                                      "property float ny", "property float nz",
                                      "element face " + std::to_string(mesh.triangles.size()),
                                      "property list uchar uint vertex_indices"}));
  std::size_t offset = 0;
  for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
    const auto position = take<Vec3<Real>>(body, offset);
    EXPECT_EQ(position, Vec3<Real>(mesh.origin + Vec3d(mesh.positions[i])));
    EXPECT_NEAR(length(Vec3d(take<Vec3f>(body, offset))), 1, 1e-7);
  }
  for (const auto& triangle : mesh.triangles) {
    EXPECT_EQ(take<std::uint8_t>(body, offset), 3);
    EXPECT_EQ((take<std::array<std::uint32_t, 3>>(body, offset)), triangle);
  }
  EXPECT_EQ(offset, body.size());
}

TEST(Ply, HoldsTheMesh) { expect_ply<float>(sphere(6), "float"); }

TEST(Ply, TakesDoublesFarOut) { expect_ply<double>(sphere(6, kFarOut), "double"); }

TEST(Stl, HoldsTheTrianglesInTheWorld) {
  const Mesh mesh = sphere(6, {100, 0, 0});
  const std::string bytes = written([&](std::ostream& stream) { write_stl(mesh, stream); });
  EXPECT_FALSE(bytes.starts_with("solid"));
  std::size_t offset = 80;
  ASSERT_EQ(take<std::uint32_t>(bytes, offset), mesh.triangles.size());
  for (const auto& triangle : mesh.triangles) {
    const auto normal = take<Vec3f>(bytes, offset);
    Vec3f middle;
    for (const std::uint32_t vertex : triangle) {
      const auto corner = take<Vec3f>(bytes, offset);
      EXPECT_EQ(corner, Vec3f(mesh.origin + Vec3d(mesh.positions[vertex])));
      middle = middle + corner - Vec3f{100, 0, 0};
    }
    EXPECT_NEAR(length(normal), 1, 1e-6);
    EXPECT_GT(dot(normal, middle), 0) << "points inward";
    EXPECT_EQ(take<std::uint16_t>(bytes, offset), 0);
  }
  EXPECT_EQ(offset, bytes.size());
}

TEST(Stl, IsSaidToLoseDigitsFarOut) {
  const OutputPlan plan =
      plan_outputs({.shapes = {"a.glb", "a.STL", "a.ply"}, .kernels = "k.ply"}, "tree.glb");
  Shape shape = sample_shape();
  EXPECT_TRUE(rounding_warnings(plan, shape).empty());
  shape.mesh = sphere(6, kFarOut);
  const std::vector<std::string> warnings = rounding_warnings(plan, shape);
  ASSERT_EQ(warnings.size(), 2u);
  EXPECT_TRUE(
      warnings[0].starts_with("a.STL: so far from the origin its floats are 0.062 apart, "
                              "and a voxel is 0.1; "))
      << warnings[0];
  EXPECT_TRUE(warnings[1].starts_with("k.ply: ")) << warnings[1];
  EXPECT_TRUE(
      rounding_warnings(plan_outputs({.shapes = {"a.glb", "a.ply"}}, "tree.glb"), shape).empty());
  shape.report.voxel_size = 10;
  EXPECT_TRUE(rounding_warnings(plan, shape).empty());
}

TEST(Kernels, StandInTheOrderOfTheSpecification) {
  Shape shape = sample_shape();
  shape.kernels[1].weight = 40;
  const auto [header, body] = read_ply(written([&](std::ostream& stream) {
    write_kernels(shape.kernels, shape.isotropic_density, stream);
  }));
  std::vector<std::string> expected{"ply", "format binary_little_endian 1.0", "element vertex 2"};
  for (const char* name : {"x", "y", "z", "nx", "ny", "nz", "ux", "uy", "uz", "vx", "vy", "vz",
                           "ru", "rv", "rn", "density", "weight"}) {
    expected.push_back(std::string("property float ") + name);
  }
  EXPECT_EQ(header, expected);
  std::size_t offset = 0;
  using Row = std::array<float, 17>;
  EXPECT_EQ(take<Row>(body, offset),
            (Row{1, 2, 3, 0, 0, 1, 1, 0, 0, 0, 1, 0, 0.75f, 0.5f, 0.25f, 2.5f, 1}));
  EXPECT_EQ(take<Row>(body, offset),
            (Row{-1, 0, 4, 0, 1, 0, 0, 0, 1, 1, 0, 0, 1.5f, 1.0f, 0.8f, 0.125f, 40}));
  EXPECT_EQ(offset, body.size());
}

}  // namespace
}  // namespace leafhull::test
