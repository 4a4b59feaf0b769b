// SPDX-License-Identifier: Apache-2.0
#include "leafhull/version.h"
#include "output/binary_record.h"
#include "output/writers.h"

namespace leafhull {

void write_kernels(std::span<const Kernel> kernels, std::span<const float> isotropic_density,
                   std::ostream& stream) {
  stream
      << "ply\nformat binary_little_endian 1.0\n"
      << "comment leafhull " << kVersion << " kernels: centre, axes n u v, radii along u v n\n"
      << "comment lengths in model units, axes are unit vectors, density is N_iso at the centre\n"
      << "comment D = weight (1 - xi)^k\n"
      << "element vertex " << kernels.size() << "\n";
  for (const char* const name : {"x", "y", "z", "nx", "ny", "nz", "ux", "uy", "uz", "vx", "vy",
                                 "vz", "ru", "rv", "rn", "density", "weight"}) {
    stream << "property float " << name << "\n";
  }
  stream << "end_header\n";

  for (std::size_t i = 0; i < kernels.size(); ++i) {
    const Kernel& k = kernels[i];
    const Vec3f minor(cross(Vec3d(k.normal), Vec3d(k.major)));
    write_record(stream, Vec3f(k.centre), k.normal, k.major, minor, k.radius_major, k.radius_minor,
                 k.radius_normal, isotropic_density[i], k.weight);
  }
}

}  // namespace leafhull
