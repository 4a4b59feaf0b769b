// SPDX-License-Identifier: Apache-2.0
#include "input/fbx.h"

#include <string_view>

#include "input/input_error.h"

namespace leafhull {

bool looks_like_fbx(ByteSpan bytes) {
  const std::string_view text = text_of(bytes);
  if (text.starts_with("Kaydara FBX Binary")) return true;
  // "; FBX 7.3.0 project file", or without it the first section.
  const std::string_view head = text.substr(0, 1024);
  return (head.starts_with(';') && head.find("FBX") != std::string_view::npos) ||
         head.find("FBXHeaderExtension") != std::string_view::npos;
}

#ifndef LEAFHULL_HAS_FBX
TreeModel read_fbx(ByteSpan, const std::string& name, const Companions&, Axes) {
  input_error(name, "", "is an FBX file, and leafhull was built without ufbx, which reads them",
              "Convert it to .glb in Blender (File > Export > glTF 2.0), or build leafhull where "
              "cargo can fetch ufbx.");
}
#endif

}  // namespace leafhull
