// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "forest/record.h"
#include "runs/sealed_json.h"

namespace leafhull {

Json json_of(const Box& box);  ///< null where it is empty
Json json_of(const TileRecord& tile);

/// @throws nlohmann::json::exception: it is no such thing.
TileRecord tile_record(const Json& json);

}  // namespace leafhull
