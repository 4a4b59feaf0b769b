// SPDX-License-Identifier: Apache-2.0
#include "forest/forest_identity.h"

#include <string>

#include "leafhull/version.h"
#include "output/report.h"
#include "runs/checksum.h"
#include "runs/identity.h"
#include "tiles/level.h"

namespace leafhull {
namespace {

std::string checksum_of(std::span<const PlacedTree> trees) {
  std::string bytes;
  for (const PlacedTree& tree : trees) {  // member by member: there is padding
    add_bytes(bytes, tree.position, tree.linear, tree.model);
    // Replace the bytes by their checksum at 1 MiB, so that a million trees take no memory.
    if (bytes.size() > std::size_t{1} << 20) bytes = record_of(bytes).sha256;
  }
  return record_of(bytes).sha256;
}

}  // namespace

Json forest_identity(const Scene& scene, std::span<const LeafSet> models,
                     const ForestOptions& options, const DeviceInfo& device, double voxel_size,
                     int edge) {
  Json leaves = Json::array();
  for (std::size_t m = 0; m < models.size(); ++m) {
    leaves.push_back({{"name", scene.models[m].name}, {"sha256", checksum_of(models[m])}});
  }
  Json identity{{"version", kVersion},
                {"device", text_of(device)},
                {"trees", scene.trees.size()},
                {"placing", checksum_of(scene.trees)},
                {"models", leaves},
                {"merge", name(options.merge)},
                {"options", options_object(resolved_shape(options))}};
  if (options.merge == Merge::canopy) {
    identity["control_scope"] = name(options.control_scope);
    identity["levels"] = options.levels;
    identity["voxel_size"] = voxel_size;
    identity["tile"] = edge;
  }
  return identity;
}

}  // namespace leafhull
