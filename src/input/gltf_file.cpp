// SPDX-License-Identifier: Apache-2.0
#include "input/gltf_file.h"

#include <algorithm>
#include <cctype>
#include <nlohmann/json.hpp>

#include "input/gltf_document.h"

namespace leafhull {
namespace {

using nlohmann::json;

constexpr std::uint32_t kJsonChunk = 0x4E4F534A;
constexpr std::uint32_t kBinaryChunk = 0x004E4942;

struct Chunks {
  std::string_view json;
  ByteSpan binary;
  std::string note{};
};

std::uint32_t little_endian(ByteSpan bytes, std::size_t at) {
  return bytes[at] | bytes[at + 1] << 8 | bytes[at + 2] << 16 |
         static_cast<std::uint32_t>(bytes[at + 3]) << 24;
}

// glTF 2.0, section 4 "GLB File Format Specification".
Chunks split_glb(ByteSpan bytes, const std::string& file) {
  constexpr std::string_view kCopyAgain =
      "The file is cut off or damaged: copy or export it again.";
  if (bytes.size() < 20) input_error(file, "GLB header", "is cut off", kCopyAgain);
  const std::uint32_t version = little_endian(bytes, 4);
  if (version != 2) {
    input_error(file, "GLB header", "version " + std::to_string(version) + " is not read, only 2",
                "Convert the file to glTF 2.0.");
  }
  const std::uint32_t length = little_endian(bytes, 8);
  if (length > bytes.size()) {
    input_error(
        file, "GLB header",
        "says " + std::to_string(length) + " bytes, the file has " + std::to_string(bytes.size()),
        kCopyAgain);
  }

  Chunks chunks;
  if (length < bytes.size()) {
    chunks.note = "the " + std::to_string(bytes.size() - length) +
                  " bytes after the end of the GLB are passed over";
    bytes = bytes.first(length);
  }
  for (std::size_t at = 12, index = 0; at < bytes.size(); ++index) {
    const std::string place = "GLB chunk " + std::to_string(index);
    if (bytes.size() - at < 8) input_error(file, place, "is cut off", kCopyAgain);
    const std::uint32_t size = little_endian(bytes, at);
    const std::uint32_t type = little_endian(bytes, at + 4);
    at += 8;
    if (size > bytes.size() - at) {
      input_error(file, place,
                  "says " + std::to_string(size) + " bytes, " + std::to_string(bytes.size() - at) +
                      " are left",
                  kCopyAgain);
    }
    if (index == 0 && type != kJsonChunk) input_error(file, place, "is not JSON", kCopyAgain);
    if (index == 0) chunks.json = text_of(bytes.subspan(at, size));
    if (index == 1 && type == kBinaryChunk) chunks.binary = bytes.subspan(at, size);
    at += size;
  }
  // Some exporters pad with zeros where the specification asks for spaces.
  while (chunks.json.ends_with('\0')) chunks.json.remove_suffix(1);
  return chunks;
}

bool is_meshopt_fallback(const json& buffer) {
  const json::json_pointer flag("/extensions/EXT_meshopt_compression/fallback");
  return buffer.contains(flag) && buffer[flag] == true;
}

void load_buffers(GltfFile& file, const json& buffers, ByteSpan binary) {
  file.owned_buffers.reserve(buffers.size());
  for (const json& buffer : buffers) {
    const std::string place = place_of("buffers", file.buffers.size());
    if (!buffer.contains("byteLength")) file.fail(place, "has no byteLength");
    const auto length = buffer["byteLength"].get<std::size_t>();
    ByteSpan bytes;
    if (buffer.contains("uri") && buffer["uri"].is_string()) {
      bytes = file.owned_buffers.emplace_back(load_uri(file, buffer["uri"], place));
    } else if (is_meshopt_fallback(buffer)) {
      file.buffers.emplace_back();
      continue;
    } else if (file.buffers.empty()) {
      bytes = binary;
    } else {
      file.fail(place, "has neither a uri nor a binary chunk");
    }
    if (bytes.size() < length) {
      file.fail(place, "needs " + std::to_string(length) + " bytes and has " +
                           std::to_string(bytes.size()));
    }
    file.buffers.push_back(bytes.first(length));
  }
}

void list_images(tinygltf::Model& model, const json& images) {
  for (const json& entry : images) {
    tinygltf::Image& image = model.images.emplace_back();
    image.bufferView = entry.value("bufferView", -1);
    if (entry.contains("uri") && entry["uri"].is_string()) image.uri = entry["uri"];
    if (entry.contains("name") && entry["name"].is_string()) image.name = entry["name"];
  }
}

// Few callers ask for cameras; those that do check them.
void list_cameras(GltfFile& file, const json& cameras) {
  const json::json_pointer type("/type"), angle("/perspective/yfov");
  for (const json& entry : cameras) {
    GltfCamera& camera = file.cameras.emplace_back();
    if (entry.contains(type) && entry[type].is_string()) camera.type = entry[type];
    if (entry.contains(angle) && entry[angle].is_number()) camera.angle = entry[angle];
  }
}

// tinygltf gets the document without buffers and images: it would load them all, reject the
// fallback buffers of compressed files, and read images beyond the end of their buffer.
void parse_model(GltfFile& file, json document) {
  document.erase("cameras");
  document.erase("buffers");
  document.erase("images");
  const std::string text = document.dump();
  std::string error, warning;
  const bool good = tinygltf::TinyGLTF().LoadASCIIFromString(
      &file.model, &error, &warning, text.data(), static_cast<unsigned>(text.size()), "");
  if (!good || !error.empty()) file.fail("", printable(error, 300));
}

/// The bytes of a data URI of any media type.
std::optional<Bytes> decode_data(const std::string& uri) {
  const std::size_t comma = uri.find(',');
  if (comma == std::string::npos) return std::nullopt;
  const std::string coding = in_lower_case(uri.substr(0, comma));
  std::string data = percent_decoded(std::string_view(uri).substr(comma + 1));
  if (!coding.ends_with(";base64")) return Bytes(data.begin(), data.end());
  std::erase_if(data, [](unsigned char c) { return std::isspace(c); });
  std::vector<std::uint8_t> bytes;
  std::string media_type;  // tinygltf knows only a few
  const std::string plain = "data:application/octet-stream;base64," + data;
  if (!tinygltf::DecodeDataURI(&bytes, media_type, plain, 0, false)) return std::nullopt;
  return Bytes(bytes.begin(), bytes.end());
}

/// Drops a query or fragment from a URI, unless a file's name has it.
Companions::Found find_uri(const Companions& companions, const std::string& uri) {
  const std::size_t end = uri.find_first_of("?#");
  try {
    return companions.find(percent_decoded(uri));
  } catch (const FileError&) {
    if (end == std::string::npos) throw;
  }
  return companions.find(percent_decoded(uri.substr(0, end)));
}

[[noreturn]] void fail_to_read(const GltfFile& file, const std::string& uri,
                               const std::string& place, const FileError& error) {
  file.fail(place, in_quotes(percent_decoded(uri)) + " cannot be read: " + error.what(),
            "Put the file beside the tree's, or export the tree as one .glb file.");
}

}  // namespace

GltfFile open_gltf(ByteSpan bytes, const std::string& name, const Companions& companions) {
  const Chunks chunks =
      text_of(bytes).starts_with("glTF") ? split_glb(bytes, name) : Chunks{text_of(bytes), {}};
  json document = parse_document(chunks.json, name);
  GltfFile file;
  file.name = name;
  file.companions = companions;
  if (!chunks.note.empty()) file.notes.push_back(chunks.note);
  if (document.contains("buffers")) load_buffers(file, document["buffers"], chunks.binary);
  if (document.contains("cameras")) list_cameras(file, document["cameras"]);
  const json images = document.contains("images") ? std::move(document["images"]) : json::array();
  parse_model(file, std::move(document));
  list_images(file.model, images);
  return file;
}

std::function<Bytes()> uri_loader(GltfFile& file, const std::string& uri,
                                  const std::string& place) {
  if (uri.starts_with("data:")) {
    return [&uri] {
      std::optional<Bytes> bytes = decode_data(uri);
      if (!bytes) {
        throw FileError("the data URI " + in_quotes(uri.substr(0, 40)) + " cannot be decoded");
      }
      return std::move(*bytes);
    };
  }
  const bool is_remote = uri.find("://") != std::string::npos && !uri.starts_with("file:");
  if (!file.companions.any() || is_remote) {
    file.fail(place, in_quotes(uri) + " is outside the file and is not looked for",
              "Put everything into one .glb file.");
  }
  try {
    const Companions::Found found = find_uri(file.companions, uri);
    if (!found.note.empty()) file.notes.push_back(place + ": " + found.note);
    return [path = found.path] { return read_file(path); };
  } catch (const FileError& error) {
    fail_to_read(file, uri, place, error);
  }
}

Bytes load_uri(GltfFile& file, const std::string& uri, const std::string& place) {
  const std::function<Bytes()> load = uri_loader(file, uri, place);
  try {
    return load();
  } catch (const FileError& error) {
    if (uri.starts_with("data:")) file.fail(place, error.what());
    fail_to_read(file, uri, place, error);
  }
}

}  // namespace leafhull
