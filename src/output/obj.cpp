// SPDX-License-Identifier: Apache-2.0
#include <array>
#include <charconv>
#include <cstdint>
#include <string_view>

#include "leafhull/version.h"
#include "output/mesh_vertex.h"
#include "output/writers.h"

namespace leafhull {
namespace {

/// One line of text, put together without a stream's formatting.
class Line {
 public:
  explicit Line(std::string_view start) { add(start); }

  void add(std::string_view text) { end_ += text.copy(end_, text.size()); }

  template <class Number>
  void add(Number number) {
    end_ = std::to_chars(end_, text_.data() + text_.size(), number).ptr;
  }

  template <class Number>
  void add(const Vec3<Number>& v) {
    for (const Number number : {v.x, v.y, v.z}) {
      add(std::string_view(" "));
      add(number);
    }
  }

  void write(std::ostream& stream) {
    add(std::string_view("\n"));
    stream.write(text_.data(), end_ - text_.data());
  }

 private:
  std::array<char, 128> text_;
  char* end_ = text_.data();
};

void write_positions(const Mesh& mesh, std::ostream& stream) {
  const bool far_out = mesh.origin != Vec3d{};
  for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
    Line line("v");
    if (far_out) {
      line.add(world_position(mesh, i));
    } else {
      line.add(mesh.positions[i]);
    }
    line.write(stream);
  }
}

}  // namespace

void write_obj(const Mesh& mesh, std::ostream& stream) {
  stream << "# leafhull " << kVersion << "\n";
  write_positions(mesh, stream);
  for (std::size_t i = 0; i < mesh.normals.size(); ++i) {
    Line line("vn");
    line.add(unit_normal(mesh, i));
    line.write(stream);
  }
  for (const auto& triangle : mesh.triangles) {
    Line line("f");
    for (const std::uint32_t vertex : triangle) {
      line.add(std::string_view(" "));
      line.add(std::uint64_t{vertex} + 1);
      line.add(std::string_view("//"));
      line.add(std::uint64_t{vertex} + 1);
    }
    line.write(stream);
  }
}

}  // namespace leafhull
