// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "leafhull/picture.h"
#include "render/buffers.h"
#include "render/camera.h"

namespace leafhull::render {

/// Ambient, diffuse and specular light on white paper, as in the left column of Figure 17.
Picture shade_phong(const Buffers& buffers);

/// As shade_phong without highlights, for small pictures that are compared.
Picture shade_matte(const Buffers& buffers);

/// 0.5 n + 0.5 in the camera's space: red to the right, green up, blue towards the eye. Paper is
/// the zero vector's grey.
Picture shade_normals(const Buffers& buffers, const Camera& camera);

/// Grey that is white where the subject is nearest, dark where it is farthest; paper is black.
Picture shade_depth(const Buffers& buffers);

}  // namespace leafhull::render
