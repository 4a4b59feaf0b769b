// SPDX-License-Identifier: Apache-2.0
#include "input/gltf_accessor.h"

#include <algorithm>
#include <cstring>
#include <limits>
#include <numeric>
#include <type_traits>

#include "input/gltf_compression.h"

namespace leafhull {
namespace {

/// A run of elements that is known to lie inside its bytes.
struct Elements {
  ByteSpan bytes{};
  std::size_t count = 0, stride = 0;
  int components = 1, component_type = 0;
  bool normalized = false;
};

std::size_t size_of(int component_type) {
  return static_cast<std::size_t>(
      tinygltf::GetComponentSizeInBytes(static_cast<std::uint32_t>(component_type)));
}

Elements elements_of(GltfFile& file, int view, std::size_t offset, Elements shape,
                     const std::string& place) {
  const std::size_t size = shape.components * size_of(shape.component_type);
  const ByteSpan bytes = view_bytes(file, view, place);
  if (shape.stride == 0) shape.stride = size;
  if (shape.stride < size) {
    file.fail(place, "byteStride " + std::to_string(shape.stride) + " is less than its elements' " +
                         std::to_string(size) + " bytes");
  }
  if (shape.count > 0 && (offset > bytes.size() || size > bytes.size() - offset ||
                          shape.count - 1 > (bytes.size() - offset - size) / shape.stride)) {
    file.fail(place, std::to_string(shape.count) + " elements from byte " + std::to_string(offset) +
                         " do not fit in the " + std::to_string(bytes.size()) + " bytes of " +
                         place_of("bufferViews", view));
  }
  shape.bytes = shape.count > 0 ? bytes.subspan(offset) : ByteSpan{};
  return shape;
}

template <class T, class Out>
Out converted(const std::uint8_t* from, bool normalized) {
  T value;
  std::memcpy(&value, from, sizeof value);
  if constexpr (std::is_integral_v<T> && std::is_floating_point_v<Out>) {
    constexpr Out kOne = std::numeric_limits<T>::max();
    if (normalized) return std::max(value / kOne, Out{-1});
  }
  return static_cast<Out>(value);
}

template <class T, class Out>
void copy_as(const Elements& from, std::size_t first, std::size_t count, Out* out) {
  const std::uint8_t* element = from.bytes.data() + first * from.stride;
  if (std::is_same_v<T, Out> && from.stride == from.components * sizeof(T)) {
    std::memcpy(out, element, count * from.stride);
    return;
  }
  for (std::size_t i = 0; i < count; ++i, element += from.stride) {
    for (int c = 0; c < from.components; ++c) {
      *out++ = converted<T, Out>(element + c * sizeof(T), from.normalized);
    }
  }
}

template <class Out>
void copy(const Elements& from, std::size_t first, std::size_t count, Out* out) {
  if (count == 0) return;
  if constexpr (std::is_same_v<Out, float>) {
    switch (from.component_type) {
      case TINYGLTF_COMPONENT_TYPE_BYTE:
        return copy_as<std::int8_t>(from, first, count, out);
      case TINYGLTF_COMPONENT_TYPE_SHORT:
        return copy_as<std::int16_t>(from, first, count, out);
      case TINYGLTF_COMPONENT_TYPE_FLOAT:
        return copy_as<float>(from, first, count, out);
    }
  } else if (from.component_type == TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT) {
    return copy_as<std::uint32_t>(from, first, count, out);
  }
  if (from.component_type == TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE) {
    copy_as<std::uint8_t>(from, first, count, out);
  } else {
    copy_as<std::uint16_t>(from, first, count, out);
  }
}

bool is_index_type(int type) {
  return type == TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE ||
         type == TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT ||
         type == TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT;
}

bool is_attribute_type(int type) {
  return type == TINYGLTF_COMPONENT_TYPE_FLOAT || type == TINYGLTF_COMPONENT_TYPE_BYTE ||
         type == TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE || type == TINYGLTF_COMPONENT_TYPE_SHORT ||
         type == TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT;
}

template <class Out>
void put_sparse_values(GltfFile& file, const tinygltf::Accessor& accessor, Elements shape, Out* out,
                       const std::string& place) {
  const auto& sparse = accessor.sparse;
  if (!is_index_type(sparse.indices.componentType)) {
    file.fail(place, "its sparse indices are not unsigned integers");
  }
  const auto count = static_cast<std::size_t>(sparse.count);
  if (count > shape.count) file.fail(place, "has more sparse values than elements");

  const Elements index_elements = elements_of(
      file, sparse.indices.bufferView, sparse.indices.byteOffset,
      {.count = count, .component_type = sparse.indices.componentType}, place + ", sparse indices");
  shape.count = count;
  shape.stride = 0;
  const Elements values = elements_of(file, sparse.values.bufferView, sparse.values.byteOffset,
                                      shape, place + ", sparse values");
  std::vector<std::uint32_t> indices(count);
  copy(index_elements, 0, count, indices.data());
  for (std::size_t i = 0; i < count; ++i) {
    if (indices[i] >= accessor.count) {
      file.fail(place, "sparse index " + std::to_string(indices[i]) + " is past its " +
                           std::to_string(accessor.count) + " elements");
    }
    copy(values, i, 1, out + static_cast<std::size_t>(indices[i]) * shape.components);
  }
}

std::size_t bytes_at_hand(const GltfFile& file) {
  return std::accumulate(file.buffers.begin(), file.buffers.end(), std::size_t{0},
                         [](std::size_t sum, ByteSpan b) { return sum + b.size(); });
}

/// An element type that accessors are read into: a fixed number of floats or indices.
template <class Element>
struct ElementType {
  using Out = float;
  static constexpr int kComponents = sizeof(Element) / sizeof(float);
  static constexpr std::size_t kElements = 1;
};
template <>
struct ElementType<std::uint32_t> {
  using Out = std::uint32_t;
  static constexpr int kComponents = 1;
  static constexpr std::size_t kElements = 1;
};
template <>
struct ElementType<std::array<std::uint32_t, 3>> {
  using Out = std::uint32_t;
  static constexpr int kComponents = 1;
  static constexpr std::size_t kElements = 3;
};

int type_of(int components) {
  if (components == 1) return TINYGLTF_TYPE_SCALAR;
  return components == 16 ? TINYGLTF_TYPE_MAT4 : components;  // TINYGLTF_TYPE_VEC2 to VEC4
}

std::string name_of_type(int components) {
  if (components == 1) return "SCALAR";
  return components == 16 ? "MAT4" : "VEC" + std::to_string(components);
}

template <class Element>
std::vector<Element> read(GltfFile& file, int index, const std::string& user) {
  using Out = typename ElementType<Element>::Out;
  constexpr int kComponents = ElementType<Element>::kComponents;
  constexpr std::size_t kElements = ElementType<Element>::kElements;
  static_assert(std::is_standard_layout_v<Element> && alignof(Element) == alignof(Out));
  if (!is_index(index, file.model.accessors.size())) {
    file.fail(user, "there is no " + place_of("accessors", index));
  }
  const std::string place = accessor_place(user, index);
  const tinygltf::Accessor& accessor = file.model.accessors[index];
  if (accessor.type != type_of(kComponents)) {
    file.fail(place, "its elements are not " + name_of_type(kComponents));
  }
  constexpr bool wants_indices = !std::is_same_v<Out, float>;
  if (!(wants_indices ? is_index_type(accessor.componentType)
                      : is_attribute_type(accessor.componentType))) {
    file.fail(place,
              "componentType " + std::to_string(accessor.componentType) + " is not allowed here");
  }

  Elements shape{.count = accessor.count,
                 .components = kComponents,
                 .component_type = accessor.componentType,
                 .normalized = accessor.normalized};
  const auto check_groups = [&] {
    if (shape.count % kElements == 0) return;
    file.fail(place, "its " + std::to_string(shape.count) + " indices are not three per triangle");
  };
  std::vector<Element> out;
  if (accessor.bufferView >= 0) {
    if (is_index(accessor.bufferView, file.model.bufferViews.size())) {
      shape.stride = file.model.bufferViews[accessor.bufferView].byteStride;
    }
    const Elements elements =
        elements_of(file, accessor.bufferView, accessor.byteOffset, shape, place);
    check_groups();
    out.resize(shape.count / kElements);
    copy(elements, 0, shape.count, reinterpret_cast<Out*>(out.data()));
  } else if (accessor.count > bytes_at_hand(file)) {
    file.fail(place, "its " + std::to_string(accessor.count) +
                         " elements have no bufferView and outnumber the bytes of the file");
  } else {
    check_groups();
    out.resize(shape.count / kElements);
  }
  if (accessor.sparse.isSparse) {
    put_sparse_values(file, accessor, shape, reinterpret_cast<Out*>(out.data()), place);
  }
  return out;
}

}  // namespace

ByteSpan view_bytes(GltfFile& file, int index, const std::string& user) {
  if (!is_index(index, file.model.bufferViews.size())) {
    file.fail(user, "there is no " + place_of("bufferViews", index));
  }
  const tinygltf::BufferView& view = file.model.bufferViews[index];
  if (view.extensions.contains("EXT_meshopt_compression")) return meshopt_bytes(file, index);
  return buffer_bytes(file, view.buffer, view.byteOffset, view.byteLength,
                      place_of("bufferViews", index));
}

ByteSpan buffer_bytes(const GltfFile& file, int index, std::size_t offset, std::size_t length,
                      const std::string& place) {
  if (!is_index(index, file.buffers.size())) {
    file.fail(place, "there is no " + place_of("buffers", index));
  }
  const ByteSpan buffer = file.buffers[index];
  if (offset > buffer.size() || length > buffer.size() - offset) {
    file.fail(place, std::to_string(length) + " bytes from byte " + std::to_string(offset) +
                         " do not fit in the " + std::to_string(buffer.size()) + " bytes of " +
                         place_of("buffers", index));
  }
  return buffer.subspan(offset, length);
}

std::vector<Vec2f> read_vec2(GltfFile& file, int accessor, const std::string& user) {
  return read<Vec2f>(file, accessor, user);
}

std::vector<Vec3f> read_vec3(GltfFile& file, int accessor, const std::string& user) {
  return read<Vec3f>(file, accessor, user);
}

std::vector<std::array<float, 4>> read_vec4(GltfFile& file, int accessor, const std::string& user) {
  return read<std::array<float, 4>>(file, accessor, user);
}

std::vector<std::array<float, 16>> read_mat4(GltfFile& file, int accessor,
                                             const std::string& user) {
  return read<std::array<float, 16>>(file, accessor, user);
}

std::vector<Vec3f> read_colors(GltfFile& file, int accessor, const std::string& user) {
  if (!is_index(accessor, file.model.accessors.size()) ||
      file.model.accessors[accessor].type == TINYGLTF_TYPE_VEC3) {
    return read_vec3(file, accessor, user);
  }
  std::vector<Vec3f> colors;
  for (const auto& [r, g, b, a] : read_vec4(file, accessor, user)) colors.push_back({r, g, b});
  return colors;
}

std::vector<std::uint32_t> read_indices(GltfFile& file, int accessor, const std::string& user) {
  return read<std::uint32_t>(file, accessor, user);
}

std::vector<std::array<std::uint32_t, 3>> read_triangles(GltfFile& file, int accessor,
                                                         const std::string& user) {
  return read<std::array<std::uint32_t, 3>>(file, accessor, user);
}

std::string accessor_place(const std::string& user, int accessor) {
  return user + " (" + place_of("accessors", accessor) + ")";
}

}  // namespace leafhull
