// SPDX-License-Identifier: Apache-2.0
#include "forest/tile_record.h"

#include <array>

namespace leafhull {

std::string name_of(const TileId& tile) {
  const auto& [x, y, z] = tile.at;
  return std::to_string(tile.level) + "/" + std::to_string(x) + "_" + std::to_string(y) + "_" +
         std::to_string(z);
}

std::string file_of(const TileId& tile) { return "tiles/" + name_of(tile) + ".glb"; }

Json json_of(const TileRow& row) {
  Json json;
  for_each_in_row(row, [&](const char* name, const auto& fact) { json[name] = fact; });
  return json;
}

Json json_of(const TileRecord& record) {
  Json json;
  for_each_in_record(record, [&](const char* name, const auto& fact) { json[name] = fact; });
  return json;
}

TileRecord tile_record(const Json& json) {
  TileRecord record;
  for_each_in_record(record, [&](const char* name, auto& fact) { json.at(name).get_to(fact); });
  return record;
}

void to_json(Json& json, const Vec3d& v) { json = {v.x, v.y, v.z}; }

void to_json(Json& json, const Box& box) {
  if (!box.empty()) json = {box.low.x, box.low.y, box.low.z, box.high.x, box.high.y, box.high.z};
}

void from_json(const Json& json, Vec3d& v) {
  const auto [x, y, z] = json.get<std::array<double, 3>>();
  v = {x, y, z};
}

void from_json(const Json& json, Box& box) {
  if (json.is_null()) return;
  const auto side = json.get<std::array<double, 6>>();
  box.low = {side[0], side[1], side[2]};
  box.high = {side[3], side[4], side[5]};
}

}  // namespace leafhull
