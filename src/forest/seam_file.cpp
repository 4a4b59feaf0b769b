// SPDX-License-Identifier: Apache-2.0
#include "forest/seam_file.h"

#include <array>
#include <cstring>
#include <type_traits>

#include "leafhull/error.h"
#include "output/binary_record.h"

namespace leafhull {
namespace {

// After the magic and the version come the counts, then the vertices, the components, and the loose
// vertices with their origin; 32-bit integers and floats, 128 bits for a volume.
constexpr std::array<char, 8> kMagic{'l', 'e', 'a', 'f', 's', 'e', 'a', 'm'};
constexpr std::uint32_t kSeamVersion = 2;

static_assert(sizeof(SeamVertex) == 6 * 4, "it is written as it lies in memory");

template <class Element>
std::uint32_t size_of(const std::vector<Element>& elements) {
  return static_cast<std::uint32_t>(elements.size());
}

template <class Element>
void write_all(std::ostream& stream, const std::vector<Element>& elements) {
  stream.write(reinterpret_cast<const char*>(elements.data()),
               static_cast<std::streamsize>(elements.size() * sizeof(Element)));
}

class Reader {
 public:
  Reader(std::string_view bytes, const std::string& where) : bytes_(bytes), where_(where) {}

  template <class Value>
  Value take() {
    return take_all<Value>(1).front();
  }

  template <class Element>
  std::vector<Element> take_all(std::size_t count) {
    static_assert(std::is_trivially_copyable_v<Element>);
    const std::size_t size = count * sizeof(Element);
    if (bytes_.size() < size) fail();
    std::vector<Element> elements(count);
    if (count > 0) std::memcpy(static_cast<void*>(elements.data()), bytes_.data(), size);
    bytes_.remove_prefix(size);
    return elements;
  }

  bool at_end() const { return bytes_.empty(); }

  [[noreturn]] void fail() const {
    throw Error(ErrorCode::input, where_ + " is damaged: it is not the seam of a tile",
                "Remove it, and --resume computes its tile again.");
  }

 private:
  std::string_view bytes_;
  const std::string& where_;
};

}  // namespace

void write_seam(const Seam& seam, std::ostream& stream) {
  write_record(stream, kMagic, kSeamVersion, seam.own_vertices, size_of(seam.borrowed),
               size_of(seam.lent), size_of(seam.components), size_of(seam.loose.positions));
  write_all(stream, seam.borrowed);
  write_all(stream, seam.lent);
  for (const SeamComponent& c : seam.components) write_record(stream, c.vertex, c.volume);
  write_record(stream, seam.loose.origin);
  write_all(stream, seam.loose.positions);
  write_all(stream, seam.loose.normals);
}

Seam read_seam(std::string_view bytes, const std::string& where) {
  Reader reader(bytes, where);
  if (reader.take<std::array<char, 8>>() != kMagic) reader.fail();
  if (reader.take<std::uint32_t>() != kSeamVersion) reader.fail();
  Seam seam;
  seam.own_vertices = reader.take<std::uint32_t>();
  const auto [borrowed, lent, components, loose] = reader.take<std::array<std::uint32_t, 4>>();
  seam.borrowed = reader.take_all<SeamVertex>(borrowed);
  seam.lent = reader.take_all<SeamVertex>(lent);
  for (std::uint32_t i = 0; i < components; ++i) {
    SeamComponent& component = seam.components.emplace_back();
    component.vertex = reader.take<std::uint32_t>();
    component.volume = reader.take<ExactVolume>();
  }
  seam.loose.origin = reader.take<Vec3d>();
  seam.loose.positions = reader.take_all<Vec3f>(loose);
  seam.loose.normals = reader.take_all<Vec3f>(loose);
  if (!reader.at_end()) reader.fail();
  return seam;
}

}  // namespace leafhull
