// SPDX-License-Identifier: Apache-2.0
#include "input/gltf_compression.h"

#include <draco/compression/decode.h>
#include <meshoptimizer.h>

#include <new>
#include <string_view>

#include "input/gltf_accessor.h"

namespace leafhull {
namespace {

/// EXT_meshopt_compression of a buffer view. Numbers that do not fit in an int are negative.
struct MeshoptView {
  int buffer, offset, length, stride, count;
  std::string mode, filter;
};

std::string text(const tinygltf::Value& object, const std::string& key) {
  return object.Has(key) && object.Get(key).IsString() ? object.Get(key).Get<std::string>() : "";
}

MeshoptView meshopt_view(const tinygltf::Value& extension) {
  return {integer(extension, "buffer", -1),
          integer(extension, "byteOffset", 0),
          integer(extension, "byteLength", -1),
          integer(extension, "byteStride", -1),
          integer(extension, "count", -1),
          text(extension, "mode"),
          text(extension, "filter")};
}

// Checks what meshoptimizer only asserts. The least compressed sizes bound memory by the file's
// length: two bits for 16 bytes of an attribute, a byte for a triangle or an index.
std::string_view defect(const MeshoptView& view) {
  if (view.offset < 0 || view.length < 0 || view.stride < 0 || view.count < 0) {
    return "lacks a number, or has one that is too large";
  }
  const std::size_t length = view.length, count = view.count, stride = view.stride;
  const bool has_filter = !view.filter.empty() && view.filter != "NONE";
  if (view.mode == "ATTRIBUTES") {
    if (stride == 0 || stride > 256 || stride % 4 != 0) return "byteStride is not 4, 8, ... 256";
    if (count * stride / 64 > length) return "byteLength is too small for its count";
  } else if (view.mode == "TRIANGLES" || view.mode == "INDICES") {
    if (stride != 2 && stride != 4) return "byteStride is not 2 or 4";
    if (view.mode == "TRIANGLES" && count % 3 != 0) return "count is not a multiple of 3";
    if (count / 3 > length) return "byteLength is too small for its count";
    if (has_filter) return "has a filter, but no attributes";
  } else {
    return "has an unknown mode";
  }
  if (view.filter == "OCTAHEDRAL" && stride != 4 && stride != 8) return "byteStride is not 4 or 8";
  if (view.filter == "QUATERNION" && stride != 8) return "byteStride is not 8";
  if (has_filter && view.filter != "OCTAHEDRAL" && view.filter != "QUATERNION" &&
      view.filter != "EXPONENTIAL") {
    return "has an unknown filter";
  }
  return {};
}

int decode_meshopt(const MeshoptView& view, ByteSpan from, Bytes& to) {
  const std::size_t count = view.count, stride = view.stride;
  if (view.mode == "TRIANGLES") {
    return meshopt_decodeIndexBuffer(to.data(), count, stride, from.data(), from.size());
  }
  if (view.mode == "INDICES") {
    return meshopt_decodeIndexSequence(to.data(), count, stride, from.data(), from.size());
  }
  const int error = meshopt_decodeVertexBuffer(to.data(), count, stride, from.data(), from.size());
  if (error != 0) return error;
  if (view.filter == "OCTAHEDRAL") meshopt_decodeFilterOct(to.data(), count, stride);
  if (view.filter == "QUATERNION") meshopt_decodeFilterQuat(to.data(), count, stride);
  if (view.filter == "EXPONENTIAL") meshopt_decodeFilterExp(to.data(), count, stride);
  return 0;
}

// Draco has more types than glTF, and takes any byte for a bool.
bool is_attribute_type(draco::DataType type) {
  return type == draco::DT_FLOAT32 || type == draco::DT_INT8 || type == draco::DT_UINT8 ||
         type == draco::DT_INT16 || type == draco::DT_UINT16;
}

template <class Vector>
std::vector<Vector> draco_vectors(const GltfFile& file, const draco::Mesh& mesh, int id,
                                  const std::string& place) {
  constexpr int kComponents = sizeof(Vector) / sizeof(float);
  const draco::PointAttribute* attribute = mesh.GetAttributeByUniqueId(id);
  if (!attribute || attribute->num_components() != kComponents ||
      !is_attribute_type(attribute->data_type())) {
    file.fail(place, "attribute " + std::to_string(id) + " is missing or of another type");
  }
  std::vector<Vector> vectors(mesh.num_points());
  for (std::uint32_t point = 0; point < mesh.num_points(); ++point) {
    const auto index = attribute->mapped_index(draco::PointIndex(point));
    if (index.value() >= attribute->size() ||
        !attribute->ConvertValue<float, kComponents>(index, &vectors[point].x)) {
      file.fail(place, "vertex " + std::to_string(point) + " cannot be decoded");
    }
  }
  return vectors;
}

/// The colours of an attribute without alpha; none if it is not a colour.
std::vector<Vec3f> draco_colors(const draco::Mesh& mesh, int id) {
  const draco::PointAttribute* attribute = mesh.GetAttributeByUniqueId(id);
  if (!attribute || !is_attribute_type(attribute->data_type()) || attribute->num_components() < 3 ||
      attribute->num_components() > 4) {
    return {};
  }
  std::vector<Vec3f> colors;
  colors.reserve(mesh.num_points());
  for (std::uint32_t point = 0; point < mesh.num_points(); ++point) {
    const auto index = attribute->mapped_index(draco::PointIndex(point));
    std::array<float, 4> color{};
    if (index.value() >= attribute->size() ||
        !attribute->ConvertValue<float>(index, attribute->num_components(), color.data())) {
      return {};
    }
    colors.push_back({color[0], color[1], color[2]});
  }
  return colors;
}

}  // namespace

ByteSpan meshopt_bytes(GltfFile& file, int index) {
  if (const auto found = file.decompressed_views.find(index);
      found != file.decompressed_views.end()) {
    return found->second;
  }
  const std::string place = place_of("bufferViews", index) + ", meshopt compression";
  const tinygltf::BufferView& described = file.model.bufferViews[index];
  const MeshoptView view =
      meshopt_view(*find_extension(described.extensions, "EXT_meshopt_compression"));
  if (const std::string_view wrong = defect(view); !wrong.empty()) file.fail(place, wrong);
  const ByteSpan compressed = buffer_bytes(file, view.buffer, view.offset, view.length, place);
  Bytes bytes(static_cast<std::size_t>(view.count) * view.stride);
  if (decode_meshopt(view, compressed, bytes) != 0) file.fail(place, "the data cannot be decoded");
  return file.decompressed_views[index] = std::move(bytes);
}

void decode_draco(const GltfFile& file, ByteSpan data, const DracoAttributes& attributes,
                  Primitive& primitive, const std::string& place) try {
  draco::DecoderBuffer buffer;
  buffer.Init(reinterpret_cast<const char*>(data.data()), data.size());
  draco::Decoder decoder;
  const auto decoded = decoder.DecodeMeshFromBuffer(&buffer);
  if (!decoded.ok()) file.fail(place, printable(decoded.status().error_msg_string()));
  const draco::Mesh& mesh = *decoded.value();

  primitive.positions = draco_vectors<Vec3f>(file, mesh, attributes.position, place);
  if (attributes.normal >= 0) {
    primitive.normals = draco_vectors<Vec3f>(file, mesh, attributes.normal, place);
  }
  if (attributes.uv >= 0) primitive.uvs = draco_vectors<Vec2f>(file, mesh, attributes.uv, place);
  if (attributes.color >= 0) primitive.colors = draco_colors(mesh, attributes.color);
  primitive.triangles.reserve(mesh.num_faces());
  for (std::uint32_t i = 0; i < mesh.num_faces(); ++i) {
    const draco::Mesh::Face& face = mesh.face(draco::FaceIndex(i));
    primitive.triangles.push_back({face[0].value(), face[1].value(), face[2].value()});
  }
} catch (const std::bad_alloc&) {
  file.fail(place, "claims more data than fits in memory");
}

}  // namespace leafhull
