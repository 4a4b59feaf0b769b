// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "input/file_bytes.h"
#include "leafhull/tree.h"

namespace leafhull {

/// Decodes PNG, JPEG, BMP, or TGA where `name` ends so. Returns an empty image and sets `reason`
/// where that is not possible.
Image decode_image(ByteSpan bytes, const std::string& name, std::string& reason);

}  // namespace leafhull
