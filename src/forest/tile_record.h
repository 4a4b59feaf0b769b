// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>

#include "leafhull/forest.h"
#include "leafhull/vec.h"
#include "runs/checksum.h"
#include "runs/sealed_json.h"
#include "tiles/tile.h"

namespace leafhull {

/// LEVEL/X_Y_Z, as in messages and file names.
std::string name_of(const TileId& tile);
/// The path of the tile's mesh in the finished forest: tiles/LEVEL/X_Y_Z.glb.
std::string file_of(const TileId& tile);

/// What is known of a tile once it is on the disk.
struct TileRecord : TileRow {
  TileRecord() = default;
  explicit TileRecord(const TileId& id)
      : TileRow{.level = id.level, .x = id.at.x, .y = id.at.y, .z = id.at.z} {}
  TileId id() const { return {level, {x, y, z}}; }

  FileRecord mesh;  ///< none where the tile holds no surface
  FileRecord seam;
  std::uint64_t own_vertices = 0, dropped_components = 0;
  Vec3d origin;  ///< of the mesh
  Box bounds;    ///< of the mesh, scene units
};

/// Calls visit(name, fact) for each fact that a report gives of a tile.
template <class Row, class Visit>
void for_each_in_row(Row& row, const Visit& visit) {
  visit("level", row.level);
  visit("x", row.x);
  visit("y", row.y);
  visit("z", row.z);
  visit("leaf_points", row.leaf_vertices);
  visit("gathered", row.gathered);
  visit("evaluated_voxels", row.evaluated_voxels);
  visit("vertices", row.vertices);
  visit("triangles", row.triangles);
  visit("seconds", row.seconds);
  visit("resident_bytes", row.resident_bytes);
  visit("rank", row.rank);
}

/// Calls visit(name, fact) for each fact that a journal gives of a tile.
template <class Record, class Visit>
void for_each_in_record(Record& record, const Visit& visit) {
  for_each_in_row(record, visit);
  visit("mesh", record.mesh);
  visit("seam", record.seam);
  visit("own_vertices", record.own_vertices);
  visit("dropped_components", record.dropped_components);
  visit("origin", record.origin);
  visit("bounds", record.bounds);
}

Json json_of(const TileRow& row);
Json json_of(const TileRecord& record);

/// @throws nlohmann::json::exception: it is not a tile's record.
TileRecord tile_record(const Json& json);

void to_json(Json& json, const Vec3d& v);
void to_json(Json& json, const Box& box);  ///< null where it is empty
void from_json(const Json& json, Vec3d& v);
void from_json(const Json& json, Box& box);

}  // namespace leafhull
