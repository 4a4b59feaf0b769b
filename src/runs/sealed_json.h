// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <string_view>

#include "runs/checksum.h"

namespace leafhull {

using Json = nlohmann::ordered_json;

/// The object with a last member that is the checksum of what comes before it.
Json sealed(Json object);

/// The object without its seal; nothing where the text is not JSON or the seal is broken.
std::optional<Json> unsealed(std::string_view text);

/// The object without its seal.
/// @param where what errors call it: a file, or a line of one.
/// @throws Error input: no JSON, no seal, a broken one, or a `schema` other than `schema`.
Json unsealed(std::string_view text, std::string_view schema, const std::string& where,
              const std::string& remedy);

/// The text of a file that holds only such an object, for people to read.
std::string sealed_text(Json object);

/// The object of such a file. @throws Error input, as above, or the file cannot be read.
Json unsealed_file(const std::filesystem::path& file, std::string_view schema,
                   const std::string& remedy);

/// JSON as text, without bytes that are not UTF-8, as some file names have them.
std::string dumped(const Json& json, int indent = -1);

// Conversions for JSON; reading throws nlohmann::json::exception where it is something else.
void to_json(Json& json, const FileRecord& file);
void from_json(const Json& json, FileRecord& file);

}  // namespace leafhull
