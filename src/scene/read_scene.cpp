// SPDX-License-Identifier: Apache-2.0
#include "leafhull/error.h"
#include "leafhull/scene.h"
#include "scene/gltf_scene.h"
#include "scene/scatter_file.h"
#include "text/file_name.h"
#include "text/text.h"

namespace leafhull {
namespace {

Scene read_scatter_file(const std::filesystem::path& path, const std::string& extension) {
  return extension == ".csv" ? read_csv_scene(path) : read_jsonl_scene(path);
}

}  // namespace

Scene read_scene(const std::filesystem::path& path, const LeafOptions& leaves,
                 const ReadOptions& reading) {
  const std::string extension = lower_extension(path);
  if (extension == ".csv" || extension == ".jsonl" || extension == ".ndjson") {
    Scene scene = read_scatter_file(path, extension);
    for (SceneModel& model : scene.models) model.reading = reading;
    return scene;
  }
  if (extension == ".glb" || extension == ".gltf") return read_gltf_scene(path, leaves, reading);
  throw Error(ErrorCode::input, printable(path.string(), 1000) + " is not a scene",
              "A scene is a scatter file (.csv or .jsonl: tree files and where they stand) or a "
              "glTF file (.glb or .gltf) whose nodes are trees.");
}

LeafSet read_model(const SceneModel& model, const LeafOptions& leaves) {
  if (!model.meshes) return find_leaves(read_tree(model.file, model.reading), leaves);
  LeafChoice choice = *model.choice;
  choice.instances.assign(model.instances.size(), true);
  return find_leaves(*model.meshes, model.instances, choice, leaves);
}

}  // namespace leafhull
