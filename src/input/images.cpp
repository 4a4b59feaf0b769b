// SPDX-License-Identifier: Apache-2.0
#include "input/images.h"

#include <stb/stb_image.h>
#include <webp/decode.h>

#include <algorithm>
#include <array>
#include <climits>
#include <cstdint>
#include <memory>
#include <string_view>

#include "input/input_error.h"
#include "input/jpeg_tables.h"
#include "text/file_name.h"
#include "text/text.h"

namespace leafhull {
namespace {

// A few bytes can claim any size; this is 256 MiB decoded.
constexpr std::int64_t kMostPixels = 8192 * 8192;
/// PNG packs more than anything else that stb_image reads: 1032 bytes of 8 pixels into one.
constexpr std::int64_t kMostPixelsPerByte = 8 * 1032;

enum class Format { stb, png, jpeg, webp, unread };

struct Signature {
  std::size_t at;
  std::string_view bytes;
  Format format;
  std::string_view name;
};

// stb_image's readers of rarer formats are not safe for untrusted files.
constexpr std::array kSignatures{
    Signature{0, "\x89PNG", Format::png, "PNG"},
    Signature{0, "\xFF\xD8\xFF", Format::jpeg, "JPEG"},
    Signature{0, "BM", Format::stb, "BMP"},
    Signature{8, "WEBP", Format::webp, "WebP"},
    Signature{0, "\xABKTX 20\xBB", Format::unread, "KTX2"},
    Signature{0, "\xABKTX 11\xBB", Format::unread, "KTX"},
    Signature{0, "DDS ", Format::unread, "DDS"},
    Signature{0, "GIF8", Format::unread, "GIF"},
    Signature{0, "8BPS", Format::unread, "Photoshop"},
    Signature{0, std::string_view("II*\0", 4), Format::unread, "TIFF"},
    Signature{0, std::string_view("MM\0*", 4), Format::unread, "TIFF"},
    Signature{0, "\x76\x2F\x31\x01", Format::unread, "OpenEXR"},
    Signature{4, "ftypavif", Format::unread, "AVIF"},
};

const Signature* signature_of(ByteSpan bytes) {
  const std::string_view text = text_of(bytes);
  const auto* found = std::ranges::find_if(kSignatures, [&](const Signature& signature) {
    return text.size() > signature.at && text.substr(signature.at).starts_with(signature.bytes);
  });
  return found == kSignatures.end() ? nullptr : found;
}

/// Whether bytes may be TGA, which has no signature, and suffice for its pixels. stb_image leaves
/// missing pixels uninitialised; if the second byte is above 1, it tries the formats that are not
/// safe for untrusted files.
bool is_tga(ByteSpan bytes) {
  constexpr std::size_t kHeader = 18;
  if (bytes.size() < kHeader || bytes[1] > 1) return false;
  const auto number = [&](std::size_t at) { return std::size_t{256} * bytes[at + 1] + bytes[at]; };
  const auto bytes_for = [](std::size_t bits) { return (bits + 7) / 8; };
  const std::size_t palette = bytes[1] * number(5) * bytes_for(bytes[7]);
  const std::size_t pixels = number(12) * number(14), pixel = bytes_for(bytes[16]);
  const bool has_runs = bytes[2] >= 9;  // runs of at most 128 pixels
  const std::size_t data = has_runs ? (pixels + 127) / 128 * (1 + pixel) : pixels * pixel;
  return kHeader + bytes[0] + palette + data <= bytes.size();
}

constexpr const char* kCutOff = "it is cut off";
constexpr std::string_view kRead = "; PNG, JPEG, WebP, BMP and TGA are read";

std::string why_unread(const Signature* signature) {
  if (!signature) return "its format is unknown" + std::string(kRead);
  if (signature->name == "KTX2") {
    return "it is a KTX2 image, so its colours and holes are lost; gltf-transform "
           "ktxdecompress IN.glb OUT.glb converts it to PNG";
  }
  return "its format is " + std::string(signature->name) + std::string(kRead);
}

/// The number of pixels. The height of a BMP whose rows begin at the top is negative.
std::int64_t pixels_of(const Image& image) {
  return std::abs(std::int64_t{image.width} * image.height);
}

bool is_too_large(const Image& image, std::string& reason) {
  const bool too_large = pixels_of(image) > kMostPixels;
  if (too_large) reason = "it is larger than 8192 x 8192 pixels";
  return too_large;
}

std::size_t bytes_of(const Image& image) {
  return std::size_t{4} * static_cast<std::size_t>(image.width) *
         static_cast<std::size_t>(image.height);
}

Image decode_webp(ByteSpan bytes, std::string& reason) {
  Image image;
  WebPBitstreamFeatures features;
  if (WebPGetFeatures(bytes.data(), bytes.size(), &features) != VP8_STATUS_OK) {
    reason = "its WebP data is damaged";
    return {};
  }
  if (features.has_animation) {
    reason = "it is an animation";
    return {};
  }
  image.width = features.width, image.height = features.height;
  if (is_too_large(image, reason)) return {};
  image.rgba.resize(bytes_of(image));
  if (!WebPDecodeRGBAInto(bytes.data(), bytes.size(), image.rgba.data(), image.rgba.size(),
                          4 * image.width)) {
    reason = "its WebP data is damaged";
    return {};
  }
  return image;
}

/// Whether no chunk of a PNG file is longer than the file, up to the last: stb_image takes memory
/// for one before it reads it.
bool has_whole_chunks(ByteSpan png) {
  std::size_t at = 8;
  while (at + 12 <= png.size()) {
    std::size_t length = 0;
    for (const std::uint8_t byte : png.subspan(at, 4)) length = 256 * length + byte;
    if (length > png.size() - at - 12) return false;
    if (text_of(png.subspan(at + 4, 4)) == "IEND") return true;
    at += 12 + length;
  }
  return false;
}

/// The reason why stb_image failed. It quotes the names of unknown chunks, which may not be text.
std::string why_stb_failed() {
  const char* told = stbi_failure_reason();
  const std::string reason = told ? printable(told) : "";
  return reason.empty() ? "its data is damaged" : reason;
}

Image decode_stb(ByteSpan bytes, std::string& reason) {
  Image image;
  const int length = static_cast<int>(bytes.size());
  int channels = 0;
  if (!stbi_info_from_memory(bytes.data(), length, &image.width, &image.height, &channels)) {
    reason = why_stb_failed();
    return {};
  }
  if (is_too_large(image, reason)) return {};
  if (pixels_of(image) == 0 || pixels_of(image) > kMostPixelsPerByte * length) {
    reason = pixels_of(image) == 0 ? "it has no pixels" : kCutOff;
    return {};
  }
  const std::unique_ptr<stbi_uc, void (*)(void*)> rgba(
      stbi_load_from_memory(bytes.data(), length, &image.width, &image.height, &channels, 4),
      &stbi_image_free);
  if (!rgba) {
    reason = why_stb_failed();
    return {};
  }
  image.rgba.assign(rgba.get(), rgba.get() + bytes_of(image));
  return image;
}

}  // namespace

Image decode_image(ByteSpan bytes, const std::string& name, std::string& reason) {
  const Signature* signature = signature_of(bytes);
  const bool is_named_tga = lower_extension(name) == ".tga" && is_tga(bytes);
  const Format format = signature ? signature->format : is_named_tga ? Format::stb : Format::unread;
  if (bytes.size() > INT_MAX || format == Format::unread) {
    reason = why_unread(signature);
    return {};
  }
  if (format == Format::png && !has_whole_chunks(bytes)) {
    reason = kCutOff;
    return {};
  }
  if (format == Format::jpeg && !has_sound_tables(bytes)) {
    reason = "its JPEG data is damaged";
    return {};
  }
  return format == Format::webp ? decode_webp(bytes, reason) : decode_stb(bytes, reason);
}

OpacityRange opacity_range(const Image& image) {
  OpacityRange range;
  for (std::size_t i = 3; i < image.rgba.size(); i += 4) {
    range.low = std::min<int>(range.low, image.rgba[i]);
    range.high = std::max<int>(range.high, image.rgba[i]);
  }
  return range;
}

void judge_alpha(TreeModel& tree, Material& material) {
  if (material.alpha_mode != AlphaMode::opaque || material.base_color_image < 0) return;
  const Image& image = tree.images[material.base_color_image];
  if (image.empty()) return;
  const OpacityRange range = opacity_range(image);
  if (range.has_holes()) material.alpha_mode = AlphaMode::mask;
  if (range.shows_nothing()) {
    tree.warnings.push_back(in_quotes(image.name) +
                            ": nothing in it is opaque; its alpha is passed over");
  }
}

Image with_opacity(const Image& colour, Image opacity) {
  const bool in_alpha = opacity_range(opacity).low < 255;
  for (int y = 0; y < opacity.height; ++y) {
    for (int x = 0; x < opacity.width; ++x) {
      std::uint8_t* pixel = &opacity.rgba[4 * (static_cast<std::size_t>(y) * opacity.width + x)];
      if (!in_alpha) pixel[3] = pixel[0];
      if (colour.empty()) {
        std::fill(pixel, pixel + 3, 255);
        continue;
      }
      const std::size_t from_x = static_cast<std::size_t>(x) * colour.width / opacity.width;
      const std::size_t from_y = static_cast<std::size_t>(y) * colour.height / opacity.height;
      std::copy_n(&colour.rgba[4 * (from_y * colour.width + from_x)], 3, pixel);
    }
  }
  return opacity;
}

}  // namespace leafhull
