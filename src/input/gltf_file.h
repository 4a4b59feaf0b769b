// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <tiny_gltf.h>

#include <functional>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "input/companions.h"
#include "input/file_bytes.h"
#include "input/input_error.h"

namespace leafhull {

/// A camera of the document. A perspective camera has a vertical angle of view in radians.
struct GltfCamera {
  std::string type;
  double angle = 0;
};

/// An opened glTF file: its document as tinygltf's types, and its bytes. The document is well typed
/// and its whole numbers fit in an int; code that follows an index must check it.
struct GltfFile {
  std::string name;                ///< the file's name in messages
  Companions companions;           ///< external buffers and images
  std::vector<std::string> notes;  ///< what was guessed and what was skipped
  tinygltf::Model model;           ///< its buffers and images hold no data
  std::vector<GltfCamera> cameras;
  std::vector<ByteSpan> buffers;     ///< as many as the document has; empty for a meshopt fallback
  std::vector<Bytes> owned_buffers;  ///< what `buffers` refers to outside the file itself
  std::map<int, Bytes> decompressed_views;  ///< of EXT_meshopt_compression, when first needed

  [[noreturn]] void fail(std::string_view place, std::string_view what,
                         std::string_view remedy = kExportAgain) const {
    input_error(name, place, what, remedy);
  }
};

/// Opens the bytes of a .glb or .gltf file; they must outlive the result.
/// @throws Error input.
GltfFile open_gltf(ByteSpan bytes, const std::string& name, const Companions& companions);

/// The bytes that a URI of the document stands for.
/// @throws Error input at `place`.
Bytes load_uri(GltfFile& file, const std::string& uri, const std::string& place);

/// A function that loads the bytes later, on any thread; the file is searched for now. `uri` is
/// written as in the document.
/// @throws Error as load_uri; the returned function throws FileError.
std::function<Bytes()> uri_loader(GltfFile& file, const std::string& uri, const std::string& place);

/// "accessors[3]"
inline std::string place_of(std::string_view list, std::size_t index) {
  return std::string(list) + '[' + std::to_string(index) + ']';
}

/// Whether a list of `size` elements has one at `index`.
inline bool is_index(int index, std::size_t size) {
  return index >= 0 && static_cast<std::size_t>(index) < size;
}

/// An extension of an object, or null.
inline const tinygltf::Value* find_extension(const tinygltf::ExtensionMap& extensions,
                                             const std::string& name) {
  const auto found = extensions.find(name);
  return found == extensions.end() ? nullptr : &found->second;
}

/// A whole number in an extension.
inline int integer(const tinygltf::Value& object, const std::string& key, int missing) {
  return object.Has(key) ? object.Get(key).GetNumberAsInt() : missing;
}

}  // namespace leafhull
