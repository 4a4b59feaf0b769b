// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "input/gltf_file.h"
#include "leafhull/tree.h"

namespace leafhull {

/// A buffer view with EXT_meshopt_compression, decompressed.
/// @throws Error input: its description or its data is damaged.
ByteSpan meshopt_bytes(GltfFile& file, int view);

/// Which of a primitive's attributes to take out of its KHR_draco_mesh_compression data; the ids
/// are Draco's, -1: not there.
struct DracoAttributes {
  int position = -1, normal = -1, uv = -1, color = -1;
};

/// Decompresses a primitive's positions, normals, uvs, colors and triangles.
/// @param place what refers to the data, for messages.
/// @throws Error input: the data is damaged.
void decode_draco(const GltfFile& file, ByteSpan data, const DracoAttributes& attributes,
                  Primitive& primitive, const std::string& place);

}  // namespace leafhull
