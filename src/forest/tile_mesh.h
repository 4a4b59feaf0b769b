// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <string_view>

#include "forest/seam_file.h"
#include "leafhull/shape.h"
#include "runs/checksum.h"

namespace leafhull {

/// Reads the mesh of a GLB that leafhull wrote. @throws Error input: it is not one.
Mesh read_mesh(std::string_view glb, const std::string& where);

/// The content of a tile's file. A damaged file is removed, so that the tile is computed again.
/// @throws Error input: it cannot be read, or its checksum differs.
std::string checked_content(const std::filesystem::path& file, const FileRecord& record);

/// Removes the connected pieces of the mesh that hold one of the components `dropped`, from the
/// seam too; what stays keeps its order.
void drop_pieces(Mesh& mesh, Seam& seam, std::span<const std::uint32_t> dropped);

Box bounds_of(const Mesh& mesh);

}  // namespace leafhull
