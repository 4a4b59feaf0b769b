// SPDX-License-Identifier: Apache-2.0
#include "forest/store.h"

#include <algorithm>
#include <cctype>
#include <system_error>
#include <utility>

#include "forest/seam_file.h"
#include "forest/tile_mesh.h"
#include "leafhull/error.h"
#include "output/mesh_vertex.h"
#include "output/writers.h"
#include "runs/difference.h"

namespace leafhull {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view kTileSchema = "leafhull-forest-tile/2";
constexpr const char* kStartOver = "--restart starts over; or name another folder.";
constexpr const char* kGoOn = "--resume continues it, --restart starts over.";

void check_writer(const std::string& writer) {
  const auto may_be = [](unsigned char c) {
    return c < 128 && (std::isalnum(c) != 0 || c == '-' || c == '_');
  };
  if (!writer.empty() && std::ranges::all_of(writer, may_be)) return;
  throw Error(ErrorCode::internal, "\"" + writer + "\" cannot name a journal",
              "Please report this with the command.");
}

void check_same_forest(const Json& there, const Json& here, const fs::path& folder) {
  const std::optional<Difference> differs = first_difference(there, here);
  if (!differs) return;
  throw Error(ErrorCode::usage, folder.string() + " holds another forest: " + differs->text(),
              kStartOver);
}

bool is_there(const fs::path& file, const FileRecord& record) {
  if (record.sha256.empty()) return true;
  std::error_code missing;
  return fs::file_size(file, missing) == record.bytes && !missing;
}

Seam seam_of(const TileSurface& surface) {
  Seam seam{.own_vertices = surface.own_vertices,
            .borrowed = surface.borrowed,
            .lent = surface.lent,
            .components = surface.components,
            .loose = {}};
  if (surface.mesh.triangles.empty()) {
    seam.loose = surface.mesh;
    for (std::size_t v = 0; v < seam.loose.normals.size(); ++v) {
      seam.loose.normals[v] = unit_normal(surface.mesh, v);
    }
  }
  return seam;
}

}  // namespace

Store::Store(const fs::path& folder, const Json& plan, const std::string& writer, bool resume,
             bool restart)
    : folder_(folder, writer),
      plan_(Json::parse(dumped(plan))),
      plan_checksum_(record_of(dumped(plan_)).sha256) {
  check_writer(writer);
  open(resume, restart);
}

void Store::open(bool resume, bool restart) {
  folder_.make_folder(folder_.path());
  if (restart || fs::exists(folder_.removed())) folder_.remove_forest();
  folder_.check_ours();
  if (fs::exists(folder_.manifest())) {
    open_finished(resume);
    return;
  }
  open_plan();
  journal_.emplace(folder_.journal(), "another process of the name " + folder_.writer());
  folder_.remove_unfinished();
  refresh();
  if (!resume && !done_.empty()) {
    throw Error(ErrorCode::usage,
                folder_.path().string() +
                    " holds an unfinished forest: " + std::to_string(done_.size()) +
                    (done_.size() == 1 ? " tile is" : " tiles are") + " done",
                kGoOn);
  }
}

void Store::open_plan() {
  if (!fs::exists(folder_.plan())) {
    folder_.write_once(folder_.plan(), sealed_text({{"schema", kPlanSchema}, {"plan", plan_}}));
  }
  check_same_forest(unsealed_file(folder_.plan(), kPlanSchema, kStartOver).at("plan"), plan_,
                    folder_.path());
}

void Store::open_finished(bool resume) {
  const Json manifest = unsealed_file(folder_.manifest(), kManifestSchema, kStartOver);
  check_same_forest(manifest.at("plan"), plan_, folder_.path());
  if (!resume) {
    throw Error(ErrorCode::usage, folder_.path().string() + " already holds this forest, finished",
                "--resume leaves it as it is, --restart starts over; or name another folder.");
  }
  const auto check = [&](const std::string& name, const Json& record) {
    const fs::path file = folder_.path() / name;
    if (is_there(file, record)) return;
    throw Error(ErrorCode::input,
                file.string() + " is missing or does not have the size that " +
                    folder_.manifest().string() + " says",
                kStartOver);
  };
  files_ = manifest.at("files");
  for (const auto& [name, record] : files_.items()) check(name, record);
  for (const Json& tile : manifest.at("tiles")) check(tile.at("file").get<std::string>(), tile);
  folder_.remove_work();  // its removal may have been cut off
  finished_ = true;
}

TileRecord Store::tile_of(const std::string& line, const std::string& where) const {
  const Json json =
      unsealed(line, kTileSchema, where,
               "Remove that journal to compute its tiles again. --restart starts over.");
  if (json.at("plan") != plan_checksum_) {
    throw Error(ErrorCode::usage, where + " belongs to another forest", kStartOver);
  }
  return tile_record(json);
}

void Store::refresh() {
  if (finished_) return;
  done_.clear();
  for (const fs::path& file : folder_.journals()) {
    std::size_t number = 0;
    for (const std::string& line : whole_lines(file)) {
      const TileRecord tile =
          tile_of(line, file.string() + ", line " + std::to_string(++number) + ",");
      done_.insert_or_assign(tile.id(), tile);
    }
  }
  std::size_t lost = 0;
  fs::path first;
  std::erase_if(done_, [&](const auto& entry) {
    const auto& [id, tile] = entry;
    const fs::path mesh = folder_.mesh(id), seam = folder_.seam(id);
    const bool has_mesh = is_there(mesh, tile.mesh);
    if (has_mesh && is_there(seam, tile.seam)) return false;
    if (lost++ == 0) first = has_mesh ? seam : mesh;
    return true;
  });
  if (lost == 0) return;
  warnings_.push_back(
      std::to_string(lost) +
      (lost == 1 ? " tile is computed again: " : " tiles are computed again, one because ") +
      first.string() + " is missing or its size has changed");
}

std::optional<Json> Store::control() const {
  const fs::path file = folder_.control();
  if (!fs::exists(file)) return std::nullopt;
  const Json kept = unsealed_file(file, kControlSchema, kStartOver);
  if (kept.at("plan") != plan_checksum_) {
    throw Error(ErrorCode::usage, file.string() + " belongs to another forest", kStartOver);
  }
  return kept.at("levels");
}

void Store::keep_control(const Json& levels) {
  folder_.write_once(
      folder_.control(),
      sealed_text({{"schema", kControlSchema}, {"plan", plan_checksum_}, {"levels", levels}}));
}

TileRecord Store::put(const TileSurface& surface, TileRecord record) {
  const Mesh& mesh = surface.mesh;
  record.vertices = mesh.positions.size();
  record.triangles = mesh.triangles.size();
  record.own_vertices = surface.own_vertices;
  record.origin = mesh.origin;
  record.bounds = bounds_of(mesh);
  record.leaf_vertices = surface.leaf_vertices;
  record.gathered = surface.gathered;
  record.evaluated_voxels = surface.evaluated_voxels;
  record.dropped_components = surface.dropped_components;
  record.mesh = {};
  if (!mesh.triangles.empty()) {
    record.mesh = folder_.write(folder_.mesh(record.id()),
                                [&](std::ostream& stream) { write_glb(mesh, stream); });
  }
  record.seam = {};
  if (const Seam seam = seam_of(surface); !seam.empty()) {
    record.seam = folder_.write(folder_.seam(record.id()),
                                [&](std::ostream& stream) { write_seam(seam, stream); });
  }
  folder_.sync();
  Json line{{"schema", kTileSchema}, {"plan", plan_checksum_}};
  line.update(json_of(record));
  journal_->append(std::move(line));
  done_.insert_or_assign(record.id(), record);
  return record;
}

FileRecord put_file(Store& store, const std::string& name, const RunFolder::Fill& fill) {
  FileRecord record = store.folder().write(store.folder().path() / name, fill);
  store.folder().sync();
  return record;
}

}  // namespace leafhull
