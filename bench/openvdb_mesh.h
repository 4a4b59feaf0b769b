// SPDX-License-Identifier: Apache-2.0
// Code that the contenders made of OpenVDB share.
#pragma once

#include <openvdb/openvdb.h>
#include <openvdb/tools/VolumeToMesh.h>

#include <vector>

#include "bench/contender.h"
#include "bench/threads.h"

namespace leafhull::bench {

inline std::vector<openvdb::Vec3d> openvdb_points(const Case& c) {
  std::vector<openvdb::Vec3d> points;
  points.reserve(c.count);
  for (const Vec3d p : read_points(c)) points.emplace_back(p.x, p.y, p.z);
  return points;
}

/// A run of `make_field`, which returns a level set, and of volumeToMesh at zero.
template <class MakeField>
Json run_openvdb(MakeField&& make_field) {
  openvdb::FloatGrid::Ptr field;
  std::vector<openvdb::Vec3s> points;
  std::vector<openvdb::Vec4I> quads;
  const double field_seconds = seconds_of([&] { field = make_field(); });
  const double mesh_seconds =
      seconds_of([&] { openvdb::tools::volumeToMesh(*field, points, quads); });
  return {{"field", field_seconds},
          {"mesh", mesh_seconds},
          {"total", field_seconds + mesh_seconds},
          {"vertices", points.size()},
          {"faces", quads.size()},
          {"active_voxels", field->activeVoxelCount()}};
}

/// A contender of OpenVDB's whose runs call make_field(points) with at most `threads` threads.
template <class MakeField>
Contender openvdb_contender(const char* name, const Case& c, int threads, MakeField make_field) {
  openvdb::initialize();
  Contender contender{.name = name, .version = OPENVDB_LIBRARY_VERSION_STRING, .threads = threads};
  contender.run = [limit = limit_threads(threads), make_field, points = openvdb_points(c)] {
    return run_openvdb([&] { return make_field(points); });
  };
  return contender;
}

}  // namespace leafhull::bench
