// SPDX-License-Identifier: Apache-2.0
#include "render/exr.h"

#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfFrameBuffer.h>
#include <OpenEXR/ImfHeader.h>
#include <OpenEXR/ImfIO.h>
#include <OpenEXR/ImfOutputFile.h>

#include <algorithm>
#include <deque>
#include <span>
#include <string>

#include "colour/colour.h"
#include "leafhull/error.h"

namespace leafhull::render {
namespace {

class MemoryStream : public Imf::OStream {
 public:
  MemoryStream() : OStream("memory") {}

  void write(const char* bytes, int count) override {
    file_.resize(std::max(file_.size(), at_ + count));
    std::copy_n(bytes, count, file_.begin() + static_cast<std::ptrdiff_t>(at_));
    at_ += count;
  }
  std::uint64_t tellp() override { return at_; }
  void seekp(std::uint64_t place) override { at_ = place; }

  std::vector<std::uint8_t> file() && { return std::move(file_); }

 private:
  std::vector<std::uint8_t> file_;
  std::uint64_t at_ = 0;
};

/// Channels of equal size, each with its own copy of the values.
class Channels {
 public:
  Channels(int width, int height) : width_(width), header_(width, height) {
    header_.compression() = Imf::ZIP_COMPRESSION;
  }

  void add_half(const std::string& name, std::span<const float> values) {
    add(name, Imf::HALF, halves_.emplace_back(values.begin(), values.end()));
  }
  void add_float(const std::string& name, std::span<const float> values) {
    add(name, Imf::FLOAT, floats_.emplace_back(values.begin(), values.end()));
  }
  void add_whole(const std::string& name, std::span<const Object> values) {
    std::vector<unsigned>& whole = wholes_.emplace_back();
    for (const Object object : values) whole.push_back(static_cast<unsigned>(object));
    add(name, Imf::UINT, whole);
  }

  std::vector<std::uint8_t> encode() const {
    MemoryStream stream;
    {
      constexpr int kOneThread = 0;  // none beside the caller's
      Imf::OutputFile file(stream, header_, kOneThread);
      file.setFrameBuffer(slices_);
      file.writePixels(header_.dataWindow().max.y + 1);
    }
    return std::move(stream).file();
  }

 private:
  template <class T>
  void add(const std::string& name, Imf::PixelType type, const std::vector<T>& values) {
    header_.channels().insert(name, Imf::Channel(type));
    slices_.insert(name, Imf::Slice(type, reinterpret_cast<char*>(const_cast<T*>(values.data())),
                                    sizeof(T), sizeof(T) * width_));
  }

  std::size_t width_;
  Imf::Header header_;
  Imf::FrameBuffer slices_;
  std::deque<std::vector<half>> halves_;
  std::deque<std::vector<float>> floats_;
  std::deque<std::vector<unsigned>> wholes_;
};

std::vector<float> component(std::span<const Vec3f> vectors, float Vec3f::*which) {
  std::vector<float> values;
  values.reserve(vectors.size());
  for (const Vec3f& v : vectors) values.push_back(v.*which);
  return values;
}

std::vector<std::uint8_t> encode(const Buffers& buffers, std::span<const Vec3f> colors) {
  Channels channels(buffers.width, buffers.height);
  channels.add_half("R", component(colors, &Vec3f::x));
  channels.add_half("G", component(colors, &Vec3f::y));
  channels.add_half("B", component(colors, &Vec3f::z));
  std::vector<float> covered(buffers.foliage);
  for (std::size_t i = 0; i < covered.size(); ++i) covered[i] += buffers.wood[i];
  channels.add_half("A", covered);
  channels.add_half("foliage", buffers.foliage);
  channels.add_half("wood", buffers.wood);
  channels.add_float("Z", buffers.depth);
  channels.add_half("N.X", component(buffers.normal, &Vec3f::x));
  channels.add_half("N.Y", component(buffers.normal, &Vec3f::y));
  channels.add_half("N.Z", component(buffers.normal, &Vec3f::z));
  channels.add_float("P.X", component(buffers.position, &Vec3f::x));
  channels.add_float("P.Y", component(buffers.position, &Vec3f::y));
  channels.add_float("P.Z", component(buffers.position, &Vec3f::z));
  channels.add_whole("id", buffers.object);
  channels.add_half("key", buffers.key);
  channels.add_half("open", buffers.open);
  return channels.encode();
}

}  // namespace

std::vector<std::uint8_t> encode_exr(const Buffers& buffers) {
  return encode(buffers, buffers.color);
}

std::vector<std::uint8_t> encode_exr(const Buffers& buffers, const Picture& picture) {
  if (picture.width != buffers.width || picture.height != buffers.height) {
    throw Error(ErrorCode::internal, "a picture of another size than its buffers");
  }
  std::vector<Vec3f> colors;
  colors.reserve(buffers.size());
  for (std::size_t i = 0; i < 3 * buffers.size(); i += 3) {
    colors.push_back(linear_of_srgb({picture.rgb[i], picture.rgb[i + 1], picture.rgb[i + 2]}));
  }
  return encode(buffers, colors);
}

}  // namespace leafhull::render
