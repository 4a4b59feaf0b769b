// SPDX-License-Identifier: Apache-2.0
#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfFrameBuffer.h>
#include <OpenEXR/ImfHeader.h>
#include <OpenEXR/ImfIO.h>
#include <OpenEXR/ImfInputFile.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <map>
#include <string>

#include "leafhull/error.h"
#include "render/exr.h"
#include "render/light.h"

namespace leafhull::render {
namespace {

class Bytes : public Imf::IStream {
 public:
  explicit Bytes(std::span<const std::uint8_t> file) : IStream("memory"), file_(file) {}
  bool read(char* to, int count) override {
    std::memcpy(to, &file_[at_], count);
    at_ += count;
    return at_ < file_.size();
  }
  std::uint64_t tellg() override { return at_; }
  void seekg(std::uint64_t place) override { at_ = place; }

 private:
  std::span<const std::uint8_t> file_;
  std::uint64_t at_ = 0;
};

struct ReadImage {
  int width, height;
  std::map<std::string, std::vector<float>> channels;
};

ReadImage decode(std::span<const std::uint8_t> bytes) {
  Bytes stream(bytes);
  Imf::InputFile file(stream);
  const auto window = file.header().dataWindow();
  ReadImage image{window.max.x + 1, window.max.y + 1, {}};
  Imf::FrameBuffer slices;
  const Imf::ChannelList& list = file.header().channels();
  for (auto channel = list.begin(); channel != list.end(); ++channel) {
    std::vector<float>& values = image.channels[channel.name()];
    values.resize(static_cast<std::size_t>(image.width) * image.height);
    slices.insert(channel.name(), Imf::Slice(Imf::FLOAT, reinterpret_cast<char*>(values.data()),
                                             sizeof(float), sizeof(float) * image.width));
  }
  file.setFrameBuffer(slices);
  file.readPixels(0, window.max.y);
  return image;
}

/// Two rows of three pixels: foliage at 1, wood at 5, paper elsewhere.
Buffers sample() {
  Buffers buffers;
  buffers.resize(3, 2);
  buffers.object[1] = Object::foliage, buffers.object[5] = Object::wood;
  buffers.foliage[1] = 0.75f, buffers.wood[1] = 0.125f, buffers.wood[5] = 1;
  buffers.depth[1] = 4.0625f, buffers.depth[5] = 5.1234567f;
  buffers.normal[1] = {0, 0.5f, -1}, buffers.normal[5] = {1, 0, 0};
  buffers.position[1] = {0.1234567f, 2, 3}, buffers.position[5] = {-1, -2, -3};
  buffers.color[1] = {0.25f, 0.5f, 0.125f}, buffers.color[5] = {1, 0.5f, 0.25f};
  buffers.key[1] = 0.25f, buffers.open[5] = 0.5f;
  return buffers;
}

TEST(RenderExr, ComesBackAsItWas) {
  const Buffers buffers = sample();
  ReadImage image = decode(encode_exr(buffers));
  EXPECT_EQ(image.width, 3);
  EXPECT_EQ(image.height, 2);
  EXPECT_EQ(image.channels.size(), 16u);
  auto& channels = image.channels;
  EXPECT_EQ(channels["R"], (std::vector<float>{0, 0.25f, 0, 0, 0, 1}));
  EXPECT_EQ(channels["G"], (std::vector<float>{0, 0.5f, 0, 0, 0, 0.5f}));
  EXPECT_EQ(channels["B"], (std::vector<float>{0, 0.125f, 0, 0, 0, 0.25f}));
  EXPECT_EQ(channels["A"], (std::vector<float>{0, 0.875f, 0, 0, 0, 1}));
  EXPECT_EQ(channels["foliage"], buffers.foliage);
  EXPECT_EQ(channels["wood"], buffers.wood);
  EXPECT_EQ(channels["Z"], buffers.depth);
  EXPECT_EQ(channels["N.X"], (std::vector<float>{0, 0, 0, 0, 0, 1}));
  EXPECT_EQ(channels["N.Y"], (std::vector<float>{0, 0.5f, 0, 0, 0, 0}));
  EXPECT_EQ(channels["N.Z"], (std::vector<float>{0, -1, 0, 0, 0, 0}));
  EXPECT_EQ(channels["P.X"], (std::vector<float>{0, 0.1234567f, 0, 0, 0, -1}));
  EXPECT_EQ(channels["P.Y"], (std::vector<float>{0, 2, 0, 0, 0, -2}));
  EXPECT_EQ(channels["P.Z"], (std::vector<float>{0, 3, 0, 0, 0, -3}));
  EXPECT_EQ(channels["id"], (std::vector<float>{0, 1, 0, 0, 0, 2}));
  EXPECT_EQ(channels["key"], buffers.key);
  EXPECT_EQ(channels["open"], buffers.open);
}

TEST(RenderExr, HoldsThePictureThatItIsGiven) {
  Picture picture{3, 2, std::vector<std::uint8_t>(18, 255)};
  picture.rgb[3] = 0, picture.rgb[4] = 188;
  ReadImage image = decode(encode_exr(sample(), picture));
  EXPECT_EQ(image.channels["R"], (std::vector<float>{1, 0, 1, 1, 1, 1}));
  EXPECT_NEAR(image.channels["G"][1], 0.5f, 0.005f);
  picture.height = 3;
  EXPECT_THROW(encode_exr(sample(), picture), Error);
}

TEST(RenderExr, IsTheSameFileEachTime) { EXPECT_EQ(encode_exr(sample()), encode_exr(sample())); }

}  // namespace
}  // namespace leafhull::render
