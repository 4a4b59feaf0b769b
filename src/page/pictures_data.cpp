// SPDX-License-Identifier: Apache-2.0
#include "page/pictures_data.h"

#include <cstdint>
#include <span>

#include "page/base64.h"
#include "page/packed_mesh.h"
#include "study/numbers.h"

namespace leafhull {
namespace {

using Json = nlohmann::json;

Json picture_data(const LabelledPicture& labelled, const std::string& subject) {
  const Picture& picture = labelled.picture;
  std::string alt = subject;
  for (const std::string& line : labelled.lines) alt += ", " + line;
  return {{"src", data_uri("image/png", encode_png(picture))},
          {"width", std::to_string(picture.width)},
          {"height", std::to_string(picture.height)},
          {"alt", alt}};
}

Json lines_data(const std::vector<std::string>& lines) {
  Json data = Json::array();
  for (const std::string& line : lines) data.push_back({{"line", line}});
  return data;
}

/// As JSON in a script element, where base64 needs no escape.
std::string mesh_text(const PackedMesh& mesh) {
  const Json json = {{"vertices", mesh.vertices},
                     {"triangles", mesh.triangles},
                     {"low", mesh.low},
                     {"step", mesh.step},
                     {"vertexBuffer", base64(mesh.vertex_buffer)},
                     {"indexBuffer", base64(mesh.index_buffer)}};
  return json.dump();
}

std::string triangles_text(const Mesh& mesh, std::size_t shown) {
  const std::string all = grouped(mesh.triangles.size()) + " triangles";
  return shown == mesh.triangles.size() ? all : all + ", simplified to " + grouped(shown) + " here";
}

}  // namespace

nlohmann::json shapes_data(const TreeStudy& tree) {
  Json shapes = Json::array();
  for (std::size_t i = 0; i < tree.meshes.size(); ++i) {
    Json shape = {
        {"method", paper_name(static_cast<Method>(i))}, {"picture", false}, {"mesh", false}};
    if (i < tree.methods.size()) {
      shape["picture"] = picture_data(tree.methods[i], tree.name + " as a shape");
      shape["lines"] = lines_data(tree.methods[i].lines);
    }
    const Mesh& mesh = tree.meshes[i];
    if (mesh.triangles.empty() || tree.bounds.empty()) {
      shape["caption"] = "no surface";
    } else {
      const PackedMesh packed = pack_mesh(mesh, tree.bounds);
      shape["mesh"] = mesh_text(packed);
      shape["caption"] = triangles_text(mesh, packed.triangles);
    }
    shapes.push_back(std::move(shape));
  }
  return shapes;
}

nlohmann::json sheet_data(const std::vector<LabelledPicture>& pictures, const std::string& tree) {
  if (pictures.empty()) return false;
  Json cells = Json::array();
  for (const LabelledPicture& picture : pictures) {
    Json cell = picture_data(picture, tree);
    cell["lines"] = lines_data(picture.lines);
    cells.push_back(std::move(cell));
  }
  return {{"cells", std::move(cells)}};
}

nlohmann::json plot_data(const Plot& plot, const std::string& alt) {
  const std::span bytes(reinterpret_cast<const std::uint8_t*>(plot.svg.data()), plot.svg.size());
  return {{"src", data_uri("image/svg+xml", bytes)}, {"file", plot.file_name}, {"alt", alt}};
}

}  // namespace leafhull
