// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <string_view>

namespace leafhull {

using Json = nlohmann::ordered_json;

/// The object with a last member that is the checksum of what comes before it.
Json sealed(Json object);

/// The object without its seal.
/// @param where what errors call it: a file, or a line of one.
/// @throws Error input: no JSON, no seal, a broken one, or a `schema` other than `schema`.
Json unsealed(std::string_view text, std::string_view schema, const std::string& where,
              const std::string& remedy);

/// Text without what is not UTF-8, such as some names of files.
std::string dumped(const Json& json, int indent = -1);

}  // namespace leafhull
