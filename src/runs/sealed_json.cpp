// SPDX-License-Identifier: Apache-2.0
#include "runs/sealed_json.h"

#include <utility>

#include "leafhull/error.h"
#include "runs/read_file.h"
#include "text/text.h"

namespace leafhull {
namespace {

constexpr const char* kSeal = "sha256";

std::string schema_of(const Json& object) {
  if (!object.is_object() || !object.contains("schema")) return "none";
  return printable(dumped(object["schema"]));
}

bool take_seal_off(Json& object) {
  if (!object.is_object() || !object.contains(kSeal)) return false;
  const Json seal = object[kSeal];
  object.erase(kSeal);
  return seal == record_of(dumped(object)).sha256;
}

}  // namespace

Json sealed(Json object) {
  object[kSeal] = record_of(dumped(object)).sha256;
  return object;
}

std::optional<Json> unsealed(std::string_view text) {
  Json object = Json::parse(text, nullptr, false);
  return take_seal_off(object) ? std::optional(std::move(object)) : std::nullopt;
}

Json unsealed(std::string_view text, std::string_view schema, const std::string& where,
              const std::string& remedy) {
  const auto refuse = [&](const std::string& why) {
    throw Error(ErrorCode::input, where + " " + why, remedy);
  };
  Json object = Json::parse(text, nullptr, false);
  if (object.is_discarded()) refuse("is damaged: it is not JSON");
  const std::string found = schema_of(object);
  const std::string wanted = dumped(Json(schema));
  if (found != wanted) {
    refuse("is from another program or version: its schema is " + found + ", not " + wanted);
  }
  if (!take_seal_off(object)) refuse("is damaged: its checksum differs");
  return object;
}

std::string sealed_text(Json object) { return dumped(sealed(std::move(object)), 2) + "\n"; }

Json unsealed_file(const std::filesystem::path& file, std::string_view schema,
                   const std::string& remedy) {
  return unsealed(content_of(file), schema, file.string(), remedy);
}

std::string dumped(const Json& json, int indent) {
  return json.dump(indent, ' ', false, Json::error_handler_t::replace);
}

void to_json(Json& json, const FileRecord& file) {
  json = {{"bytes", file.bytes}, {"sha256", file.sha256}};
}

void from_json(const Json& json, FileRecord& file) {
  json.at("bytes").get_to(file.bytes);
  json.at("sha256").get_to(file.sha256);
}

}  // namespace leafhull
