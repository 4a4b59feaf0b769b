// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "input/gltf_file.h"
#include "leafhull/vec.h"

namespace leafhull {

/// The bytes of a buffer view, decompressed where EXT_meshopt_compression asks for it.
/// @param user what refers to the view, for messages.
/// @throws Error input: there is no such view, or it does not lie inside its buffer.
ByteSpan view_bytes(GltfFile& file, int view, const std::string& user);

/// A part of a buffer.
/// @throws Error input at `place`: there is no such buffer, or the part does not lie inside it.
ByteSpan buffer_bytes(const GltfFile& file, int buffer, std::size_t offset, std::size_t length,
                      const std::string& place);

/// The elements of an accessor with its sparse values. Integers become floats, normalised if the
/// accessor says so. Memory is allocated only for data that is known to lie inside the file.
/// @param user what refers to the accessor, for messages.
/// @throws Error input: no such accessor, another type of elements, or elements outside of a view.
std::vector<Vec2f> read_vec2(GltfFile& file, int accessor, const std::string& user);
std::vector<Vec3f> read_vec3(GltfFile& file, int accessor, const std::string& user);
std::vector<std::array<float, 4>> read_vec4(GltfFile& file, int accessor, const std::string& user);

/// Column by column.
std::vector<std::array<float, 16>> read_mat4(GltfFile& file, int accessor, const std::string& user);

/// The red, green and blue of colours; an alpha is dropped.
std::vector<Vec3f> read_colors(GltfFile& file, int accessor, const std::string& user);

/// The elements of an accessor of unsigned scalars, singly or three per triangle.
std::vector<std::uint32_t> read_indices(GltfFile& file, int accessor, const std::string& user);
std::vector<std::array<std::uint32_t, 3>> read_triangles(GltfFile& file, int accessor,
                                                         const std::string& user);

/// "meshes[0], POSITION (accessors[3])"
std::string accessor_place(const std::string& user, int accessor);

}  // namespace leafhull
