// SPDX-License-Identifier: Apache-2.0
#include "page/pictures_data.h"

#include <cstdint>
#include <span>

#include "page/base64.h"
#include "page/packed_mesh.h"
#include "page/typeset.h"
#include "study/numbers.h"

namespace leafhull {
namespace {

using Json = nlohmann::json;

constexpr int kQuality = 85;

Json picture_data(const Picture& picture, const std::string& alt) {
  return {{"src", data_uri("image/jpeg", encode_jpeg(picture, kQuality))},
          {"width", std::to_string(picture.width)},
          {"height", std::to_string(picture.height)},
          {"alt", alt}};
}

Json lines_data(const std::vector<std::string>& lines) {
  Json data = Json::array();
  for (const std::string& line : lines) data.push_back({{"line", typeset(line)}});
  return data;
}

/// The mesh as JSON for a script element, where base64 needs no escapes.
std::string mesh_text(const PackedMesh& mesh) {
  const Json json = {{"vertices", mesh.vertices},
                     {"triangles", mesh.triangles},
                     {"low", mesh.low},
                     {"step", mesh.step},
                     {"vertexBuffer", base64(mesh.vertex_buffer)},
                     {"indexBuffer", base64(mesh.index_buffer)}};
  return json.dump();
}

/// The counts of a shape, and a note if the view shows fewer triangles than it has.
std::string caption(const StudyRow& row) {
  if (row.empty) return "no surface";
  return grouped(row.metrics.dilated_voxels) + " dilated voxels, " + grouped(row.off_site()) +
         " off-site vertices";
}

std::string simplification(const Mesh& mesh, const PackedMesh& shown) {
  if (shown.triangles == mesh.triangles.size()) return "";
  return "turning: " + grouped(shown.triangles) + " of " + grouped(mesh.triangles.size()) +
         " triangles";
}

}  // namespace

nlohmann::json shapes_data(const TreeStudy& tree) {
  Json shapes = Json::array();
  for (std::size_t i = 0; i < tree.meshes.size(); ++i) {
    const std::string method(paper_name(static_cast<Method>(i)));
    Json shape = {{"method", method},
                  {"caption", caption(tree.readings.front().table1[i])},
                  {"picture", false},
                  {"mesh", false}};
    if (i < tree.methods.size()) {
      shape["picture"] = picture_data(tree.methods[i].picture, tree.name + " by " + method);
    }
    if (!tree.meshes[i].triangles.empty() && !tree.bounds.empty()) {
      const PackedMesh packed = pack_mesh(tree.meshes[i], tree.bounds);
      shape["mesh"] = {{"data", mesh_text(packed)}};
      shape["simplification"] = simplification(tree.meshes[i], packed);
    }
    shapes.push_back(std::move(shape));
  }
  return shapes;
}

nlohmann::json sheet_data(const std::vector<LabelledPicture>& pictures, const std::string& tree) {
  if (pictures.empty()) return false;
  Json cells = Json::array();
  for (const LabelledPicture& picture : pictures) {
    std::string alt = tree;
    for (const std::string& line : picture.lines) alt += ", " + line;
    Json cell = picture_data(picture.picture, alt);
    cell["lines"] = lines_data(picture.lines);
    cells.push_back(std::move(cell));
  }
  return {{"cells", std::move(cells)}};
}

nlohmann::json plot_data(const std::string& svg, const std::string& alt) {
  const std::span bytes(reinterpret_cast<const std::uint8_t*>(svg.data()), svg.size());
  return {{"src", data_uri("image/svg+xml", bytes)}, {"alt", alt}};
}

}  // namespace leafhull
