// SPDX-License-Identifier: Apache-2.0
// Any bytes are either a tree that keeps what tree.h promises, or an Error input.
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdlib>

#include "input/gltf.h"
#include "leafhull/error.h"

namespace {

void require(bool promise) {
  if (!promise) std::abort();
}

void check(const leafhull::TreeModel& tree) {
  for (const leafhull::Instance& instance : tree.instances) {
    require(instance.primitive < tree.primitives.size());
    for (const auto& row : instance.to_world)
      for (const double entry : row) require(std::isfinite(entry));
  }
  for (const leafhull::Primitive& primitive : tree.primitives) {
    const std::size_t count = primitive.positions.size();
    require(primitive.material < static_cast<int>(tree.materials.size()));
    require(primitive.normals.empty() || primitive.normals.size() == count);
    require(primitive.uvs.empty() || primitive.uvs.size() == count);
    for (const leafhull::Vec3f p : primitive.positions)
      require(std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z));
    for (const auto& triangle : primitive.triangles)
      for (const std::uint32_t vertex : triangle) require(vertex < count);
  }
  for (const leafhull::Material& material : tree.materials)
    require(material.base_color_image < static_cast<int>(tree.images.size()));
  for (const leafhull::Image& image : tree.images)
    require(image.rgba.empty() ||
            image.rgba.size() == std::size_t(image.width) * std::size_t(image.height) * 4);
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  try {
    check(leafhull::read_gltf({data, size}, "fuzz", {}));
  } catch (const leafhull::Error& error) {
    require(error.code() == leafhull::ErrorCode::input);
    for (const char* c = error.what(); *c; ++c) require(*c != '\n');
  }
  return 0;
}
