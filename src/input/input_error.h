// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "input/file_bytes.h"
#include "text/text.h"

namespace leafhull {

/// The remedy for a file that contradicts itself.
inline constexpr std::string_view kExportAgain =
    "Export the tree again; the Khronos glTF validator lists what is wrong in a glTF file.";

/// The remedy for a mesh with values that are not numbers.
inline constexpr std::string_view kRepairMesh =
    "Repair the mesh in the program that made it, then export it again.";

/// A warning that follows the name of its subject.
inline constexpr std::string_view kNotAllFinite =
    "not all values are finite; leaves that hold such a value are dropped";

/// @throws Error input, always: "file: place: what", the place left out where it is empty.
[[noreturn]] void input_error(std::string_view file, std::string_view place, std::string_view what,
                              std::string_view remedy = kExportAgain);

/// The content of a file or pipe that a user named. @throws Error input.
Bytes read_named_file(const std::filesystem::path& path, std::string_view remedy);

/// "3 hidden meshes are passed over"
std::string hidden_meshes(std::size_t count);

/// `printable` in quotes.
std::string in_quotes(std::string_view text);

}  // namespace leafhull
