// SPDX-License-Identifier: Apache-2.0
#include "forest/seam_file.h"

#include <array>
#include <cstring>
#include <type_traits>

#include "leafhull/error.h"
#include "output/binary_record.h"

namespace leafhull {
namespace {

// Behind the magic and the version: how many there are of each, then the vertices, the components,
// and the loose vertices with their origin; 32-bit integers and floats, 128 bits for a volume.
constexpr std::array<char, 8> kMagic{'l', 'e', 'a', 'f', 's', 'e', 'a', 'm'};
constexpr std::uint32_t kVersion1 = 1;

template <class Element>
std::uint32_t size_of(const std::vector<Element>& elements) {
  return static_cast<std::uint32_t>(elements.size());
}

class Reader {
 public:
  Reader(std::string_view bytes, const std::string& where) : bytes_(bytes), where_(where) {}

  template <class Value>
  Value take() {
    static_assert(std::is_trivially_copyable_v<Value>);
    need(sizeof(Value));
    Value value;
    std::memcpy(&value, bytes_.data(), sizeof value);
    bytes_.remove_prefix(sizeof value);
    return value;
  }

  void need(std::uint64_t bytes) const {
    if (bytes_.size() < bytes) fail();
  }
  void end() const {
    if (!bytes_.empty()) fail();
  }
  [[noreturn]] void fail() const {
    throw Error(ErrorCode::input, where_ + " is damaged: it is no seam of a tile",
                "Remove it: with --resume its tile is computed again.");
  }

 private:
  std::string_view bytes_;
  const std::string& where_;
};

constexpr std::uint64_t kVertexBytes = 6 * 4, kComponentBytes = 4 + 16, kLooseBytes = 6 * 4;

void take(Reader& reader, std::vector<SeamVertex>& vertices) {
  for (SeamVertex& v : vertices) {
    v.cell = reader.take<Coord>();
    v.patch = reader.take<std::uint32_t>();
    v.vertex = reader.take<std::uint32_t>();
    v.component = reader.take<std::uint32_t>();
  }
}

}  // namespace

void write_seam(const Seam& seam, std::ostream& stream) {
  write_record(stream, kMagic, kVersion1, seam.own_vertices, size_of(seam.borrowed),
               size_of(seam.lent), size_of(seam.components), size_of(seam.loose.positions));
  for (const auto* vertices : {&seam.borrowed, &seam.lent}) {
    for (const SeamVertex& v : *vertices) {
      write_record(stream, v.cell, v.patch, v.vertex, v.component);
    }
  }
  for (const SeamComponent& c : seam.components) write_record(stream, c.vertex, c.volume);
  write_record(stream, seam.loose.origin);
  for (std::size_t v = 0; v < seam.loose.positions.size(); ++v) {
    write_record(stream, seam.loose.positions[v], seam.loose.normals[v]);
  }
}

Seam read_seam(std::string_view bytes, const std::string& where) {
  Reader reader(bytes, where);
  if (reader.take<std::array<char, 8>>() != kMagic) reader.fail();
  if (reader.take<std::uint32_t>() != kVersion1) reader.fail();
  Seam seam;
  seam.own_vertices = reader.take<std::uint32_t>();
  const auto borrowed = reader.take<std::uint32_t>();
  const auto lent = reader.take<std::uint32_t>();
  const auto components = reader.take<std::uint32_t>();
  const auto loose = reader.take<std::uint32_t>();
  reader.need((std::uint64_t{borrowed} + lent) * kVertexBytes + components * kComponentBytes +
              loose * kLooseBytes);
  seam.borrowed.resize(borrowed);
  seam.lent.resize(lent);
  seam.components.resize(components);
  seam.loose.positions.resize(loose);
  seam.loose.normals.resize(loose);
  take(reader, seam.borrowed);
  take(reader, seam.lent);
  for (SeamComponent& c : seam.components) {
    c.vertex = reader.take<std::uint32_t>();
    c.volume = reader.take<ExactVolume>();
  }
  seam.loose.origin = reader.take<Vec3d>();
  for (std::uint32_t v = 0; v < loose; ++v) {
    seam.loose.positions[v] = reader.take<Vec3f>();
    seam.loose.normals[v] = reader.take<Vec3f>();
  }
  reader.end();
  return seam;
}

}  // namespace leafhull
