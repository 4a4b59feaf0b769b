// SPDX-License-Identifier: Apache-2.0
#include "surface/polygonise.h"

#include <malloc.h>
#include <openvdb/tools/VolumeToMesh.h>
#include <tbb/parallel_for.h>

#include <algorithm>

#include "density/field_grid.h"

#ifdef LEAFHULL_OPENVDB_HAS_MESHER
// The library has this one compiled (cmake/dependencies.cmake checks); here it would take half a
// minute.
extern template void openvdb::tools::VolumeToMesh::operator()(const openvdb::FloatGrid&);
#endif

namespace leafhull {
namespace {

using openvdb::tools::PolygonPool;
using Face = std::array<std::uint32_t, 4>;

void copy_faces(const PolygonPool& pool, Face* to) {
  for (std::size_t q = 0; q < pool.numQuads(); ++q) {
    const openvdb::Vec4I& v = pool.quad(q);
    *to++ = {v[0], v[1], v[2], v[3]};
  }
  for (std::size_t t = 0; t < pool.numTriangles(); ++t) {
    const openvdb::Vec3I& v = pool.triangle(t);
    *to++ = {v[0], v[1], v[2], v[2]};
  }
}

Polygons by_volume_to_mesh(const Field& field, double adaptivity) {
  openvdb::tools::VolumeToMesh mesher(static_cast<double>(field.iso_value()), adaptivity);
  mesher(negated_grid(field));

  Polygons polygons;
  polygons.points.resize(mesher.pointListSize());
  tbb::parallel_for(std::size_t{0}, polygons.points.size(), [&](std::size_t i) {
    const openvdb::Vec3s& p = mesher.pointList()[i];
    polygons.points[i] = {p.x(), p.y(), p.z()};
  });

  const std::size_t pools = mesher.polygonPoolListSize();
  std::vector<std::size_t> first{0};  // face of each pool
  for (std::size_t i = 0; i < pools; ++i) {
    const PolygonPool& pool = mesher.polygonPoolList()[i];
    first.push_back(first.back() + pool.numQuads() + pool.numTriangles());
  }
  polygons.faces.resize(first.back());
  tbb::parallel_for(std::size_t{0}, pools, [&](std::size_t i) {
    copy_faces(mesher.polygonPoolList()[i], polygons.faces.data() + first[i]);
  });
  return polygons;
}

}  // namespace

Polygons polygonise(const Field& field, double adaptivity) {
  Polygons polygons = by_volume_to_mesh(field, adaptivity);
  // The mesher leaves small free blocks on the heap, as large as the field together. They would add
  // to the next stage's peak memory; giving them back takes time only if there are many.
  constexpr std::size_t kManySamples = std::size_t{1} << 22;
  if (field.sample_count() > kManySamples) malloc_trim(0);
  return polygons;
}

std::vector<std::array<std::uint32_t, 3>> triangulate(const Polygons& polygons) {
  const auto distance = [&](std::uint32_t a, std::uint32_t b) {
    return length(polygons.points[a] - polygons.points[b]);
  };
  std::vector<std::array<std::uint32_t, 3>> triangles(2 * polygons.faces.size());
  tbb::parallel_for(std::size_t{0}, polygons.faces.size(), [&](std::size_t f) {
    const auto [a, b, c, d] = polygons.faces[f];
    const bool cut_from_a = c == d || distance(a, c) <= distance(b, d);
    triangles[2 * f] = cut_from_a ? std::array{a, b, c} : std::array{a, b, d};
    triangles[2 * f + 1] = cut_from_a ? std::array{a, c, d} : std::array{b, c, d};
  });
  std::erase_if(triangles, [](const auto& t) { return t[1] == t[2]; });  // of a triangle
  return triangles;
}

}  // namespace leafhull
