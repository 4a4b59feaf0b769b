// SPDX-License-Identifier: Apache-2.0
#include "input/foreign.h"

#include <algorithm>
#include <array>
#include <string_view>

#include "input/input_error.h"
#include "text/file_name.h"

namespace leafhull {
namespace {

struct Foreign {
  std::string_view extension;  ///< one or more, each after a blank
  std::string_view magic;      ///< the file's first bytes; or none
  std::string_view name;
  std::string_view import;  ///< Blender's operator; empty: it opens the file itself
  std::string_view remedy;  ///< the advice if Blender cannot open it
};

constexpr std::array kForeign{
    Foreign{" .blend", "BLENDER", "a Blender file", "", ""},
    Foreign{" .usd .usda .usdc .usdz", "PXR-USDC", "a USD file", "wm.usd_import", ""},
    Foreign{" .usda", "#usda", "a USD file", "wm.usd_import", ""},
    Foreign{" .dae", "", "a COLLADA file", "wm.collada_import", ""},
    Foreign{" .abc", "Ogawa", "an Alembic file", "wm.alembic_import", ""},
    Foreign{" .ply", "ply\n", "a PLY file", "wm.ply_import", ""},
    Foreign{" .stl", "solid ", "an STL file", "wm.stl_import", ""},
    Foreign{" .spm .spk .srt .st .st9 .stsdk", "", "a SpeedTree file", "",
            "Export the tree from SpeedTree's Modeler as FBX (Export > Mesh)."},
    Foreign{" .max .3ds .ma .mb .c4d .hip .hiplc .lwo", "", "a scene of a modelling program", "",
            "Export the tree from there as glTF, FBX or OBJ."},
    Foreign{" .unitypackage .prefab .uasset", "", "an asset of a game engine", "",
            "Export the tree from there as glTF or FBX."},
    Foreign{" .vdb", "", "an OpenVDB file", "", "Give the tree that it was made from."},
    Foreign{" .zip .7z .rar .gz", "PK\x03\x04", "an archive", "", "Unpack it, and give the tree."},
};

bool has_extension(const Foreign& foreign, const std::string& extension) {
  const std::string list = std::string(foreign.extension) + " ";
  return !extension.empty() && list.find(" " + extension + " ") != std::string::npos;
}

/// A name that is safe in a Python string inside a shell's double quotes, else `instead`.
std::string for_python(const std::string& name, std::string_view instead) {
  const auto is_special = [](unsigned char c) {
    return c < ' ' ||
           std::string_view("'\\\"$`!").find(static_cast<char>(c)) != std::string_view::npos;
  };
  return std::ranges::any_of(name, is_special) ? std::string(instead) : name;
}

/// The Blender command that converts the file to .glb.
std::string conversion(const Foreign& foreign, const std::filesystem::path& path) {
  const std::string file = for_python(path.string(), "FILE");
  const std::string glb = for_python(path.stem().string() + ".glb", "FILE.glb");
  std::string open = "blender -b --python-expr \"import bpy; ";
  if (foreign.import.empty()) {
    open = "blender -b '" + file + "' --python-expr \"import bpy; ";
  } else {
    open += "bpy.ops.wm.read_factory_settings(use_empty=True); bpy.ops." +
            std::string(foreign.import) + "(filepath='" + file + "'); ";
  }
  return open + "bpy.ops.export_scene.gltf(filepath='" + glb + "')\"";
}

}  // namespace

std::optional<ForeignFormat> foreign_format(ByteSpan bytes, const std::filesystem::path& path) {
  const std::string extension = lower_extension(path);
  const auto is_it = [&](const Foreign& foreign) {
    return has_extension(foreign, extension) ||
           (!foreign.magic.empty() && text_of(bytes).starts_with(foreign.magic));
  };
  const auto* found = std::ranges::find_if(kForeign, is_it);
  if (found == kForeign.end()) return std::nullopt;
  ForeignFormat format{std::string(found->name), std::string(found->remedy)};
  if (format.remedy.empty()) {
    format.remedy = "Convert it: " + conversion(*found, path);
    if (found->import == "wm.collada_import") format.remedy += " (Blender 4.5 or older)";
  }
  return format;
}

}  // namespace leafhull
