// SPDX-License-Identifier: Apache-2.0
#include "output/vdb.h"

#include <openvdb/io/Archive.h>

#include <array>
#include <bit>
#include <cstdint>
#include <cstdio>
#include <sstream>
#include <string>
#include <string_view>

namespace leafhull {
namespace {

/// io::File's format for any stream that can seek; io::Stream would leave out the grids' offsets,
/// without which a reader cannot load lazily.
struct SeekableArchive : openvdb::io::Archive {
  void write_to(std::ostream& stream, const openvdb::GridBase::ConstPtr& grid) const {
    write(stream, openvdb::GridCPtrVec{grid}, /*seekable=*/true);
  }
};

/// FNV-1a over 64-bit words.
class Digest {
 public:
  void add(std::uint64_t word) { value_ = (value_ ^ word) * 0x100000001b3u; }
  void add(std::string_view text) {
    for (const char character : text) add(static_cast<std::uint64_t>(character));
  }
  std::uint64_t value() const { return value_ ^ (value_ >> 32); }

 private:
  std::uint64_t value_ = 0xcbf29ce484222325u;
};

Digest digest_of(const openvdb::FloatGrid& grid) {
  std::ostringstream description;
  description << grid.transform();
  for (auto meta = grid.beginMeta(); meta != grid.endMeta(); ++meta) {
    description << meta->first << '=' << meta->second->str() << '\n';
  }
  Digest digest;
  digest.add(description.str());
  for (auto leaf = grid.tree().cbeginLeaf(); leaf; ++leaf) {
    const openvdb::Coord origin = leaf->origin();
    for (const auto index : {origin.x(), origin.y(), origin.z()}) {
      digest.add(static_cast<std::uint64_t>(index));
    }
    const float* const values = leaf->buffer().data();
    for (openvdb::Index i = 0; i < leaf->SIZE; ++i) {
      digest.add(std::bit_cast<std::uint32_t>(values[i]));
    }
  }
  return digest;
}

/// A UUID (RFC 9562, version 8) that depends on the content alone.
std::string content_uuid(const openvdb::FloatGrid& grid) {
  Digest digest = digest_of(grid);
  const std::uint64_t high = digest.value();
  digest.add(high);
  const std::uint64_t low = digest.value();
  std::array<char, 37> text;
  std::snprintf(text.data(), text.size(), "%08x-%04x-8%03x-%04x-%04x%08x", unsigned(high >> 32),
                unsigned(high >> 16 & 0xffff), unsigned(high & 0xfff),
                unsigned(0x8000 | (low >> 48 & 0x3fff)), unsigned(low >> 32 & 0xffff),
                unsigned(low & 0xffffffff));
  return text.data();
}

}  // namespace

void write_vdb(const openvdb::FloatGrid::ConstPtr& grid, std::ostream& stream) {
  // After the magic number, three version numbers and a flag comes a random UUID, the only part of
  // the file that differs between two runs.
  constexpr std::streamoff kUuidOffset = 8 + 3 * 4 + 1;
  SeekableArchive().write_to(stream, grid);
  stream.seekp(kUuidOffset);
  const std::string uuid = content_uuid(*grid);
  stream.write(uuid.data(), static_cast<std::streamsize>(uuid.size()));
  stream.seekp(0, std::ios_base::end);
}

}  // namespace leafhull
