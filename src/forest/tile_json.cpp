// SPDX-License-Identifier: Apache-2.0
#include "forest/tile_json.h"

#include <array>

namespace leafhull {
namespace {

Vec3d point_of(const Json& json) {
  const auto [x, y, z] = json.get<std::array<double, 3>>();
  return {x, y, z};
}

Box box_of(const Json& json) {
  if (json.is_null()) return {};
  const auto side = json.get<std::array<double, 6>>();
  Box box;
  box.low = {side[0], side[1], side[2]};
  box.high = {side[3], side[4], side[5]};
  return box;
}

TileId id_of(const Json& json) {
  const auto number = json.get<std::array<int, 4>>();
  return {number[0], {number[1], number[2], number[3]}};
}

}  // namespace

Json json_of(const Box& box) {
  if (box.empty()) return nullptr;
  return {box.low.x, box.low.y, box.low.z, box.high.x, box.high.y, box.high.z};
}

Json json_of(const TileRecord& tile) {
  const auto& [x, y, z] = tile.id.at;
  return {{"tile", {tile.id.level, x, y, z}},
          {"mesh", tile.mesh},
          {"seam", tile.seam},
          {"vertices", tile.vertices},
          {"triangles", tile.triangles},
          {"own_vertices", tile.own_vertices},
          {"origin", {tile.origin.x, tile.origin.y, tile.origin.z}},
          {"bounds", json_of(tile.bounds)},
          {"leaf_vertices", tile.leaf_vertices},
          {"gathered", tile.gathered},
          {"evaluated_voxels", tile.evaluated_voxels},
          {"dropped_components", tile.dropped_components},
          {"seconds", tile.seconds},
          {"resident_bytes", tile.resident_bytes},
          {"rank", tile.rank}};
}

TileRecord tile_record(const Json& json) {
  return {.id = id_of(json.at("tile")),
          .mesh = json.at("mesh").get<FileRecord>(),
          .seam = json.at("seam").get<FileRecord>(),
          .vertices = json.at("vertices").get<std::uint64_t>(),
          .triangles = json.at("triangles").get<std::uint64_t>(),
          .own_vertices = json.at("own_vertices").get<std::uint64_t>(),
          .origin = point_of(json.at("origin")),
          .bounds = box_of(json.at("bounds")),
          .leaf_vertices = json.at("leaf_vertices").get<std::uint64_t>(),
          .gathered = json.at("gathered").get<std::uint64_t>(),
          .evaluated_voxels = json.at("evaluated_voxels").get<std::uint64_t>(),
          .dropped_components = json.at("dropped_components").get<std::uint64_t>(),
          .seconds = json.at("seconds").get<double>(),
          .resident_bytes = json.at("resident_bytes").get<std::uint64_t>(),
          .rank = json.at("rank").get<int>()};
}

}  // namespace leafhull
