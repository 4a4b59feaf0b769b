// SPDX-License-Identifier: Apache-2.0
#include "surface/polygonise.h"

#include <openvdb/tools/VolumeToMesh.h>

namespace leafhull {

Polygons polygonise(const openvdb::FloatGrid& depth, double adaptivity) {
  openvdb::tools::VolumeToMesh mesher(0.0, adaptivity);
  mesher(depth);

  Polygons polygons;
  polygons.points.reserve(mesher.pointListSize());
  for (std::size_t i = 0; i < mesher.pointListSize(); ++i) {
    const openvdb::Vec3s& p = mesher.pointList()[i];
    polygons.points.emplace_back(p.x(), p.y(), p.z());
  }
  std::size_t faces = 0;
  for (std::size_t i = 0; i < mesher.polygonPoolListSize(); ++i) {
    const openvdb::tools::PolygonPool& pool = mesher.polygonPoolList()[i];
    faces += pool.numQuads() + pool.numTriangles();
  }
  polygons.faces.reserve(faces);
  for (std::size_t i = 0; i < mesher.polygonPoolListSize(); ++i) {
    const openvdb::tools::PolygonPool& pool = mesher.polygonPoolList()[i];
    for (std::size_t q = 0; q < pool.numQuads(); ++q) {
      const openvdb::Vec4I& v = pool.quad(q);
      polygons.faces.push_back({v[0], v[1], v[2], v[3]});
    }
    for (std::size_t t = 0; t < pool.numTriangles(); ++t) {
      const openvdb::Vec3I& v = pool.triangle(t);
      polygons.faces.push_back({v[0], v[1], v[2], v[2]});
    }
  }
  return polygons;
}

std::vector<std::array<std::uint32_t, 3>> triangulate(const Polygons& polygons) {
  const auto distance = [&](std::uint32_t a, std::uint32_t b) {
    return length(polygons.points[a] - polygons.points[b]);
  };
  std::vector<std::array<std::uint32_t, 3>> triangles;
  triangles.reserve(2 * polygons.faces.size());
  for (const auto& [a, b, c, d] : polygons.faces) {
    if (c == d) {
      triangles.push_back({a, b, c});
    } else if (distance(a, c) <= distance(b, d)) {
      triangles.push_back({a, b, c});
      triangles.push_back({a, c, d});
    } else {
      triangles.push_back({a, b, d});
      triangles.push_back({b, c, d});
    }
  }
  return triangles;
}

}  // namespace leafhull
