// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

namespace leafhull::test {

/// A PNG file of 8-bit RGBA pixels, rows from the top, stored without compression.
inline std::vector<std::uint8_t> png(int width, int height, std::span<const std::uint8_t> rgba) {
  using Bytes = std::vector<std::uint8_t>;
  const auto big_endian = [](Bytes& to, std::uint32_t v) {
    for (int shift : {24, 16, 8, 0}) to.push_back(std::uint8_t(v >> shift));
  };
  const auto crc = [](std::span<const std::uint8_t> bytes) {
    std::uint32_t c = ~0u;
    for (const std::uint8_t byte : bytes) {
      c ^= byte;
      for (int bit = 0; bit < 8; ++bit) c = c & 1 ? 0xEDB88320u ^ (c >> 1) : c >> 1;
    }
    return ~c;
  };

  Bytes file{0x89, 'P', 'N', 'G', '\r', '\n', 0x1A, '\n'};
  const auto chunk = [&](std::string_view type, const Bytes& data) {
    big_endian(file, std::uint32_t(data.size()));
    const std::size_t start = file.size();
    file.insert(file.end(), type.begin(), type.end());
    file.insert(file.end(), data.begin(), data.end());
    big_endian(file, crc(std::span(file).subspan(start)));
  };

  Bytes header;
  big_endian(header, std::uint32_t(width));
  big_endian(header, std::uint32_t(height));
  header.insert(header.end(), {8, 6, 0, 0, 0});
  chunk("IHDR", header);

  Bytes scanlines;
  scanlines.reserve(std::size_t(height) * (1 + std::size_t(width) * 4));
  for (int row = 0; row < height; ++row) {
    scanlines.push_back(0);
    const auto pixels = rgba.subspan(std::size_t(row) * width * 4, std::size_t(width) * 4);
    scanlines.insert(scanlines.end(), pixels.begin(), pixels.end());
  }
  Bytes zlib{0x78, 0x01};
  for (std::size_t at = 0; at < scanlines.size();) {
    const std::size_t length = std::min<std::size_t>(scanlines.size() - at, 65535);
    const std::uint16_t n = std::uint16_t(length);
    zlib.push_back(at + length == scanlines.size());
    for (const std::uint16_t v : {n, std::uint16_t(~n)}) {
      zlib.push_back(std::uint8_t(v));
      zlib.push_back(std::uint8_t(v >> 8));
    }
    zlib.insert(zlib.end(), scanlines.begin() + at, scanlines.begin() + at + length);
    at += length;
  }
  std::uint32_t a = 1, b = 0;
  for (const std::uint8_t byte : scanlines) {
    a = (a + byte) % 65521;
    b = (b + a) % 65521;
  }
  big_endian(zlib, b << 16 | a);
  chunk("IDAT", zlib);
  chunk("IEND", {});
  return file;
}

}  // namespace leafhull::test
