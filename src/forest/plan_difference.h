// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>

#include "forest/sealed_json.h"

namespace leafhull {

/// Says where two plans first differ: "scene.file is "a" there and "b" here".
std::optional<std::string> difference(const Json& there, const Json& here);

}  // namespace leafhull
