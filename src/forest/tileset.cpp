// SPDX-License-Identifier: Apache-2.0
#include "forest/tileset.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <sstream>
#include <string_view>

#include "leafhull/error.h"
#include "leafhull/version.h"

namespace leafhull {
namespace {

struct Node {
  std::string content;  ///< its file; empty: it has no surface
  Box bounds;           ///< of its surface and of all under it, with glTF's axes
  double error = 0;
  std::vector<TileId> children;
};

struct Octree {
  std::map<TileId, Node> nodes;  ///< by level, the finest first
  Node root;                     ///< over all nodes of the coarsest level, or the only one there
};

double diagonal(const Box& box) { return length(box.size()); }

/// The tiles with a surface and all their ancestors, up to the coarsest level that has a surface.
Octree octree_of(std::span<const TileRecord> tiles, std::span<const double> errors) {
  Octree octree;
  auto& [nodes, root] = octree;
  for (const TileRecord& tile : tiles) {
    if (tile.mesh.sha256.empty()) continue;
    Node& node = nodes[tile.id()];
    node.content = file_of(tile.id());
    node.bounds = tile.bounds;
  }
  if (nodes.empty()) throw Error(ErrorCode::empty, "no tile of the forest has a surface");

  const int top = nodes.rbegin()->first.level;
  // A parent that is made on the way comes later in the map, so it is visited as well.
  for (auto& [id, node] : nodes) {
    node.error = errors[static_cast<std::size_t>(id.level)];
    Node& parent = id.level == top ? root : nodes[id.parent()];
    parent.bounds.include(node.bounds.low);
    parent.bounds.include(node.bounds.high);
    parent.children.push_back(id);
  }
  if (root.children.size() == 1) {
    root = nodes.at(root.children.front());
  } else {  // it shows nothing
    root.error = std::max(diagonal(root.bounds), nodes.rbegin()->second.error);
  }
  return octree;
}

/// Half of [low, high], such that `centre` minus and plus it reach both ends after rounding.
double half_length(double low, double high, double centre) {
  double half = std::max(high - centre, centre - low);
  while (centre - half > low || centre + half < high) half = std::nextafter(half, HUGE_VAL);
  return half;
}

/// Centre and three half axes of a box, whose (x, y, z) become (x, -z, y).
Json bounding_volume(const Box& box) {
  const Vec3d low{box.low.x, -box.high.z, box.low.y};
  const Vec3d high{box.high.x, -box.low.z, box.high.y};
  const Vec3d centre = low + (high - low) * 0.5;
  const double x = half_length(low.x, high.x, centre.x);
  const double y = half_length(low.y, high.y, centre.y);
  const double z = half_length(low.z, high.z, centre.z);
  return {{"box", {centre.x, centre.y, centre.z, x, 0, 0, 0, y, 0, 0, 0, z}}};
}

/// Writes an object on one line but for its last member, whose value `write` writes.
template <class Write>
void write_object(std::ostream& out, const Json& object, const char* key, Write&& write) {
  const std::string text = object.dump();
  out << std::string_view(text).substr(0, text.size() - 1) << ",\"" << key << "\":";
  write();
  out << "}";
}

/// Writes a tile and all under it, each on a line of its own, indented to its depth in the tree.
void write_tile(std::ostream& out, const Octree& octree, const Node& node, std::size_t depth) {
  Json tile = {{"boundingVolume", bounding_volume(node.bounds)}, {"geometricError", node.error}};
  if (depth == 0) tile["refine"] = "REPLACE";  // inherited
  if (!node.content.empty()) tile["content"] = {{"uri", node.content}};
  if (node.children.empty()) {
    out << tile;
    return;
  }
  write_object(out, tile, "children", [&] {
    for (const TileId& id : node.children) {
      out << (id == node.children.front() ? "[\n" : ",\n") << std::string(depth + 1, ' ');
      write_tile(out, octree, octree.nodes.at(id), depth + 1);
    }
    out << "]";
  });
}

}  // namespace

std::string tileset_json(std::span<const TileRecord> tiles, std::span<const double> errors) {
  const Octree octree = octree_of(tiles, errors);
  const Json generator = {{"generator", std::string("leafhull ") + kVersion}};
  const Json tileset = {{"asset", {{"version", "1.1"}, {"extras", generator}}},
                        {"geometricError", diagonal(octree.root.bounds) + octree.root.error}};
  std::ostringstream out;
  write_object(out, tileset, "root", [&] {
    out << "\n";
    write_tile(out, octree, octree.root, 0);
  });
  out << "\n";
  return out.str();
}

}  // namespace leafhull
