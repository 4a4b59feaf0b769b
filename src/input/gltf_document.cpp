// SPDX-License-Identifier: Apache-2.0
#include "input/gltf_document.h"

#include <algorithm>
#include <array>
#include <climits>
#include <cstdint>

#include "input/gltf_file.h"
#include "input/input_error.h"

namespace leafhull {
namespace {

using nlohmann::json;

// Functions that recurse over the document then stay far from the end of the stack.
constexpr int kDeepestNesting = 64;
constexpr std::int64_t kLargestOffset = std::int64_t{1} << 53;  // exact in every JSON reader

constexpr std::array kReadExtensions = {
    "EXT_mesh_gpu_instancing", "EXT_meshopt_compression",
    "EXT_texture_webp",        "KHR_draco_mesh_compression",
    "KHR_mesh_quantization",   "KHR_materials_pbrSpecularGlossiness",
    "KHR_node_visibility",     "KHR_texture_basisu",
    "KHR_texture_transform",   "MSFT_lod"};

constexpr std::array kHarmlessExtensions = {
    "ADOBE_materials_", "EXT_lights_", "EXT_texture_avif", "KHR_lights_",
    "KHR_materials_",   "KHR_xmp",     "MSFT_texture_dds"};

constexpr std::array kWholeNumbers = {"buffer",
                                      "bufferView",
                                      "byteLength",
                                      "byteOffset",
                                      "byteStride",
                                      "camera",
                                      "componentType",
                                      "count",
                                      "index",
                                      "indices",
                                      "inverseBindMatrices",
                                      "mesh",
                                      "material",
                                      "mode",
                                      "sampler",
                                      "scene",
                                      "skeleton",
                                      "skin",
                                      "source",
                                      "texCoord"};

constexpr std::array kLists = {"accessors", "bufferViews", "buffers", "cameras",
                               "images",    "materials",   "meshes",  "nodes",
                               "samplers",  "scenes",      "skins",   "textures"};

// Members that tinygltf would parse at a cost or risk, though leafhull does not need them.
constexpr std::array kUnreadMembers = {"animations", "extensions", "extras"};

bool is_read_extension(std::string_view name) {
  return std::ranges::find(kReadExtensions, name) != kReadExtensions.end();
}

int nesting(std::string_view text) {
  int depth = 0, deepest = 0;
  bool in_string = false;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const char c = text[i];
    if (in_string && c == '\\') {
      ++i;
    } else if (c == '"') {
      in_string = !in_string;
    } else if (!in_string && (c == '[' || c == '{')) {
      deepest = std::max(deepest, ++depth);
    } else if (!in_string && (c == ']' || c == '}')) {
      --depth;
    }
  }
  return deepest;
}

class DocumentCheck {
 public:
  DocumentCheck(json& document, const std::string& file) : document_(document), file_(file) {}

  void run() {
    check_version();
    check_required_extensions();
    for (const char* member : kUnreadMembers) document_.erase(member);
    check_whole_numbers(document_, "scene");
    for (const char* list : kLists) check_list(list);
    if (document_.contains("nodes")) check_node_numbers();
    if (document_.contains("meshes")) take_out_draco_indices();
  }

 private:
  [[noreturn]] void fail(const std::string& place, const std::string& what,
                         std::string_view remedy = kExportAgain) const {
    input_error(file_, place, what, remedy);
  }

  void check_version() const {
    if (!document_.is_object() || !document_.contains("asset") || !document_["asset"].is_object() ||
        !document_["asset"].contains("version") || !document_["asset"]["version"].is_string()) {
      fail("", "this JSON is not a glTF document (it has no asset.version)",
           "Give a .glb, .gltf or .obj file.");
    }
    const auto version = document_["asset"]["version"].get<std::string>();
    if (!version.starts_with("2.")) {
      fail("asset", "glTF version " + in_quotes(version) + " is not read, only 2.x",
           "Convert the file to glTF 2.0.");
    }
  }

  void check_required_extensions() const {
    if (!document_.contains("extensionsRequired")) return;
    for (const json& entry : document_["extensionsRequired"]) {
      const std::string name = entry.is_string() ? entry.get<std::string>() : entry.dump();
      const auto is_prefix = [&](std::string_view prefix) { return name.starts_with(prefix); };
      if (!is_read_extension(name) && std::ranges::none_of(kHarmlessExtensions, is_prefix)) {
        fail("extensionsRequired", in_quotes(name) + " is not supported",
             "Export the tree without this extension.");
      }
    }
  }

  void check_list(const std::string& list) {
    if (!document_.contains(list)) return;
    if (!document_[list].is_array()) fail(list, "is not a list");
    std::size_t index = 0;
    for (json& entry : document_[list]) {
      const std::string place = place_of(list, index++);
      if (!entry.is_object()) fail(place, "is not an object");
      check_object(entry, place);
    }
  }

  // tinygltf ignores numbers of the wrong kind and truncates large ones to 32 bits.
  void check_object(json& value, const std::string& place) {
    if (value.is_array()) {
      for (json& element : value) check_object(element, place);
    }
    if (!value.is_object()) return;
    value.erase("extras");
    take_out_unread_extensions(value);
    for (auto& [key, member] : value.items()) {
      if (std::ranges::find(kWholeNumbers, key) != kWholeNumbers.end()) {
        check_whole_numbers(value, key, place);
      } else if (key == "attributes") {
        for (auto& [name, accessor] : member.items()) check_whole_number(accessor, name, place);
      } else if (key == "targets" && member.is_array()) {
        for (json& target : member) {
          if (!target.is_object()) fail(place, "a morph target is not an object");
          for (auto& [name, accessor] : target.items()) check_whole_number(accessor, name, place);
        }
      } else if (key == "weights") {
        check_weights(member, place);
      } else if (key == "joints" || key == "children" || (key == "nodes" && member.is_array())) {
        for (const json& node : member) check_whole_number(node, key, place);
      }
      check_object(member, place);
    }
  }

  static void take_out_unread_extensions(json& value) {
    if (!value.contains("extensions")) return;
    json read = json::object();
    for (auto& [name, extension] : value["extensions"].items()) {
      if (is_read_extension(name) && extension.is_object()) read[name] = std::move(extension);
    }
    value["extensions"] = std::move(read);
  }

  void check_whole_numbers(const json& object, const std::string& key,
                           const std::string& place = {}) const {
    if (!object.contains(key)) return;
    const json& member = object[key];
    if (key == "indices" && member.is_object()) return;  // of a sparse accessor
    if (key == "mode" && member.is_string()) return;     // of EXT_meshopt_compression
    check_whole_number(member, key, place);
  }

  void check_whole_number(const json& number, const std::string& key,
                          const std::string& place) const {
    const bool wide = place.starts_with("buffer") && key.starts_with("byte");
    const std::uint64_t largest = wide ? kLargestOffset : INT_MAX;
    if (!number.is_number_unsigned() || number.get<std::uint64_t>() > largest) {
      fail(place, printable(key) + " is " + printable(number.dump()) +
                      ", not a whole number from 0 to " + std::to_string(largest));
    }
  }

  void check_weights(const json& weights, const std::string& place) const {
    const auto is_number = [](const json& v) { return v.is_number(); };
    if (!weights.is_array() || !std::ranges::all_of(weights, is_number)) {
      fail(place, "its weights are not numbers");
    }
  }

  void check_node_numbers() const {
    std::size_t index = 0;
    for (const json& node : document_["nodes"]) {
      const std::string place = place_of("nodes", index++);
      check_numbers(node, "matrix", 16, place);
      check_numbers(node, "translation", 3, place);
      check_numbers(node, "rotation", 4, place);
      check_numbers(node, "scale", 3, place);
    }
  }

  void check_numbers(const json& object, const std::string& key, std::size_t size,
                     const std::string& place) const {
    if (!object.contains(key)) return;
    const json& list = object[key];
    const auto is_number = [](const json& v) { return v.is_number(); };
    if (!list.is_array() || list.size() != size || !std::ranges::all_of(list, is_number)) {
      fail(place, key + " is not " + std::to_string(size) + " numbers");
    }
  }

  // Compressed data has its own indices, and tinygltf rejects accessors without data.
  void take_out_draco_indices() {
    for (json& mesh : document_["meshes"]) {
      if (!mesh.contains("primitives")) continue;
      for (json& primitive : mesh["primitives"]) {
        if (primitive.is_object() && primitive.contains("extensions") &&
            primitive["extensions"].contains("KHR_draco_mesh_compression")) {
          primitive.erase("indices");
        }
      }
    }
  }

  json& document_;
  const std::string& file_;
};

}  // namespace

json parse_document(std::string_view text, const std::string& file) {
  if (nesting(text) > kDeepestNesting) {
    input_error(file, "JSON", "is nested more than " + std::to_string(kDeepestNesting) + " deep");
  }
  json document;
  try {
    document = json::parse(text);
  } catch (const json::exception& error) {
    const std::string_view what = error.what();
    input_error(file, "JSON", printable(what.substr(what.find(']') + 2), 300));
  }
  DocumentCheck(document, file).run();
  return document;
}

}  // namespace leafhull
