// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "density.h"

namespace recount {

/// A binary little-endian PLY: the vertices' properties by name, and the faces cut into triangles.
struct Ply {
  std::size_t vertex_count = 0;
  std::map<std::string, std::vector<double>> properties;
  std::vector<std::array<std::uint32_t, 3>> triangles;

  /// @throws std::runtime_error if the file has no such property.
  const std::vector<double>& property(const std::string& name) const;
  std::vector<Point> points(const std::string& x, const std::string& y, const std::string& z) const;
};

/// @throws std::runtime_error naming the file and what is wrong with it.
Ply read_ply(const std::filesystem::path& path);

}  // namespace recount
