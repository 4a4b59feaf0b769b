// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <map>
#include <numbers>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include "leafhull/shape.h"
#include "temporary_folder.h"

namespace leafhull::test {

inline std::string read_file(const std::filesystem::path& path) {
  std::ifstream stream(path, std::ios::binary);
  std::ostringstream content;
  content << stream.rdbuf();
  return content.str();
}

inline void write_file(const std::filesystem::path& path, const std::string& content) {
  std::ofstream(path, std::ios::binary) << content;
}

template <class Writer>
std::string written(Writer&& writer) {
  std::ostringstream stream;
  writer(stream);
  return stream.str();
}

/// Reads a value of type T from a file's bytes and moves `offset` past it.
template <class T>
T take(const std::string& bytes, std::size_t& offset) {
  T value;
  if (offset + sizeof value > bytes.size()) throw std::out_of_range("the file ends too early");
  std::memcpy(&value, bytes.data() + offset, sizeof value);
  offset += sizeof value;
  return value;
}

/// A closed sphere of radius 2 from `rings` times `2 * rings` quads and a fan at each pole. Its
/// normals are a little too long, like rounded ones.
inline Mesh sphere(int rings, Vec3d origin = {}) {
  Mesh mesh;
  mesh.origin = origin;
  const int sectors = 2 * rings;
  const auto add = [&](double polar, double azimuth) {
    const Vec3d n{std::sin(polar) * std::cos(azimuth), std::sin(polar) * std::sin(azimuth),
                  std::cos(polar)};
    mesh.positions.push_back(Vec3f(n * 2.0));
    mesh.normals.push_back(Vec3f(n * 1.001));
  };
  add(0, 0);
  for (int r = 1; r < rings; ++r) {
    for (int s = 0; s < sectors; ++s) {
      add(std::numbers::pi * r / rings, 2 * std::numbers::pi * s / sectors);
    }
  }
  add(std::numbers::pi, 0);
  const auto at = [&](int r, int s) {
    return static_cast<std::uint32_t>(1 + (r - 1) * sectors + s % sectors);
  };
  const auto last = static_cast<std::uint32_t>(mesh.positions.size() - 1);
  for (int s = 0; s < sectors; ++s) {
    mesh.triangles.push_back({0, at(1, s), at(1, s + 1)});
    for (int r = 1; r + 1 < rings; ++r) {
      mesh.triangles.push_back({at(r, s), at(r + 1, s), at(r + 1, s + 1)});
      mesh.triangles.push_back({at(r, s), at(r + 1, s + 1), at(r, s + 1)});
    }
    mesh.triangles.push_back({at(rings - 1, s), last, at(rings - 1, s + 1)});
  }
  return mesh;
}

/// A shape with two kernels and a resolved report.
Shape sample_shape();

}  // namespace leafhull::test
