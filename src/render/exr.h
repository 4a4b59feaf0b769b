// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "leafhull/picture.h"
#include "render/buffers.h"

namespace leafhull::render {

/// The buffers as an OpenEXR file. Its channels: R G B, the surfaces' colours, linear; A, how much
/// of the pixel is covered, which `foliage` and `wood` share; Z, the depth; N.X N.Y N.Z; P.X P.Y
/// P.Z; `id`, 0 on paper, 1 on foliage, 2 on wood; `key` and `open`, the light that arrives.
std::vector<std::uint8_t> encode_exr(const Buffers& buffers);

/// As above, but R G B hold a picture of the buffers' size, linear.
std::vector<std::uint8_t> encode_exr(const Buffers& buffers, const Picture& picture);

}  // namespace leafhull::render
