// SPDX-License-Identifier: Apache-2.0
#include <string>
#include <string_view>

#include "input/fbx.h"
#include "input/file_bytes.h"
#include "input/foreign.h"
#include "input/gltf.h"
#include "input/input_error.h"
#include "input/obj.h"
#include "input/up.h"
#include "leafhull/tree.h"
#include "text/file_name.h"

namespace leafhull {
namespace {

bool looks_like_gltf(std::string_view text) {
  if (text.starts_with("\xEF\xBB\xBF")) text.remove_prefix(3);  // a byte order mark
  const std::size_t first = text.find_first_not_of(" \t\r\n");
  return text.starts_with("glTF") || (first != std::string_view::npos && text[first] == '{');
}

}  // namespace

TreeModel read_tree(const std::filesystem::path& path, const ReadOptions& options) {
  constexpr std::string_view kFormats = "Give a .glb, .gltf, .fbx or .obj file.";
  const Bytes bytes =
      read_named_file(path, "Give the path of a .glb, .gltf, .fbx or .obj file that you may read.");
  const std::string extension = lower_extension(path);
  if (bytes.empty()) input_error(path.string(), "", "is empty", kFormats);

  TreeModel tree;
  const Companions companions(path, options.allow_outside);
  if (looks_like_gltf(text_of(bytes))) {
    tree = read_gltf(bytes, path.string(), companions);
  } else if (looks_like_fbx(bytes)) {
    tree = read_fbx(bytes, path.string(), companions,
                    options.up ? Axes::as_they_are : Axes::as_it_says);
  } else if (extension == ".obj") {
    tree = read_obj(bytes, path.string(), companions);
  } else if (extension == ".glb" || extension == ".gltf" || extension == ".fbx") {
    input_error(path.string(), "",
                std::string("is not ") + (extension == ".fbx" ? "an FBX" : "a glTF") +
                    " file despite its name",
                kFormats);
  } else {
    if (const auto foreign = foreign_format(bytes, path)) {
      input_error(path.string(), "", "is " + foreign->name + ", which is not read",
                  foreign->remedy);
    }
    input_error(path.string(), "", "is not a glTF, FBX or OBJ file", kFormats);
  }
  tree.path = path;
  if (options.up == Up::z) {
    for (Instance& instance : tree.instances) instance.to_world = z_up_to_y_up(instance.to_world);
  }
  return tree;
}

}  // namespace leafhull
