// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <ostream>
#include <span>

#include "leafhull/shape.h"

namespace leafhull {

// Each function writes one whole file. Exceptions of the stream pass through; a mesh that the
// format cannot hold throws Error output.

/// Binary glTF 2.0: one node, moved to Mesh::origin, with one single-sided leaf-green material.
void write_glb(const Mesh& mesh, std::ostream& stream);

/// As write_glb, for a mesh that was read from such a file: its unit normals stay bit for bit.
void write_glb_again(const Mesh& mesh, std::ostream& stream);

/// The same scene as JSON with its buffer as a data URI: one file, a third larger than a GLB.
void write_gltf(const Mesh& mesh, std::ostream& stream);

/// Wavefront OBJ, `v`, `vn` and `f a//a`; the shortest digits that give the same number back.
void write_obj(const Mesh& mesh, std::ostream& stream);

/// Binary little-endian PLY; positions are `double` where Mesh::origin is not zero, else `float`.
void write_ply(const Mesh& mesh, std::ostream& stream);

/// Binary STL; positions are rounded to `float`, far from the origin too.
void write_stl(const Mesh& mesh, std::ostream& stream);

/// One binary little-endian PLY vertex per kernel, `density` holding N_iso(c_j). SPEC: 7.
void write_kernels(std::span<const Kernel> kernels, std::span<const float> isotropic_density,
                   std::ostream& stream);

}  // namespace leafhull
