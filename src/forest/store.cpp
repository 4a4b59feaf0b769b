// SPDX-License-Identifier: Apache-2.0
#include "forest/store.h"

#include <algorithm>
#include <optional>
#include <set>
#include <system_error>
#include <utility>

#include "forest/forest_folder.h"
#include "forest/plan_difference.h"
#include "forest/seam_file.h"
#include "forest/tile_json.h"
#include "forest/tile_mesh.h"
#include "leafhull/error.h"
#include "output/line_file.h"
#include "output/mesh_vertex.h"
#include "output/temporary_file.h"
#include "output/write_error.h"
#include "output/writers.h"

namespace leafhull {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view kTileSchema = "leafhull-forest-tile/1";
constexpr const char* kStartOver = "--restart starts over; or name another folder.";
constexpr const char* kGoOn = "--resume goes on, --restart starts over.";

void check_writer(const std::string& writer) {
  const auto may_be = [](unsigned char c) {
    return c < 128 && (std::isalnum(c) != 0 || c == '-' || c == '_');
  };
  if (!writer.empty() && std::ranges::all_of(writer, may_be)) return;
  throw Error(ErrorCode::internal, "\"" + writer + "\" cannot name a journal",
              "Please report this with the command.");
}

void check_same_forest(const Json& there, const Json& here, const fs::path& folder) {
  const std::optional<std::string> differs = difference(there, here);
  if (!differs) return;
  throw Error(ErrorCode::usage, folder.string() + " holds another forest: " + *differs, kStartOver);
}

Json read_sealed(const fs::path& file, std::string_view schema) {
  return unsealed(content_of(file), schema, file.string(), kStartOver);
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

struct Store::Impl {
  Impl(const fs::path& at, const Json& what, const std::string& who)
      : folder(at, who), writer(who), plan(Json::parse(dumped(what))) {}

  void open(bool resume, bool restart);
  void open_finished(bool resume);
  void open_plan() const;
  void refresh();
  std::map<TileId, TileRecord> journalled() const;
  TileRecord tile_of(const std::string& line, const std::string& where) const;

  ForestFolder folder;
  std::string writer;
  Json plan;  ///< as it is after a way over the disk
  std::string plan_checksum = record_of(dumped(plan)).sha256;
  bool finished = false;
  Json files;  ///< of a finished forest, by name
  std::optional<LineFile> journal;
  std::map<TileId, TileRecord> done;
  std::set<int> synced;  ///< levels whose folders are known to last
  std::vector<std::string> warnings;
};

void Store::Impl::open(bool resume, bool restart) {
  std::error_code error;
  fs::create_directories(folder.path(), error);
  if (error) throw write_error(folder.path(), error.value());

  if (restart || fs::exists(folder.removed())) folder.remove_forest();
  folder.check_ours();
  if (fs::exists(folder.manifest())) {
    open_finished(resume);
    return;
  }
  open_plan();
  journal.emplace(folder.journal(), "another process of the name " + writer);
  sync_folder(folder.work());
  folder.remove_temporary();
  refresh();
  if (!resume && !done.empty()) {
    throw Error(ErrorCode::usage,
                folder.path().string() +
                    " holds an unfinished forest: " + std::to_string(done.size()) +
                    (done.size() == 1 ? " tile is" : " tiles are") + " done",
                kGoOn);
  }
}

void Store::Impl::open_plan() const {
  if (!fs::exists(folder.plan())) {
    const Json file = sealed({{"schema", kPlanSchema}, {"plan", plan}});
    folder.write_once(folder.plan(), dumped(file, 2) + "\n");
  }
  check_same_forest(read_sealed(folder.plan(), kPlanSchema).at("plan"), plan, folder.path());
}

void Store::Impl::open_finished(bool resume) {
  const Json manifest = read_sealed(folder.manifest(), kManifestSchema);
  check_same_forest(manifest.at("plan"), plan, folder.path());
  if (!resume) {
    throw Error(ErrorCode::usage, folder.path().string() + " holds this forest, finished",
                "--resume leaves it as it is, --restart starts over; or name another folder.");
  }
  const auto check = [&](const fs::path& file, const Json& record) {
    if (is_there(folder.path() / file, file_record(record))) return;
    throw Error(ErrorCode::input,
                (folder.path() / file).string() + " is missing or has another size than " +
                    folder.manifest().string() + " says",
                kStartOver);
  };
  files = manifest.at("files");
  for (const auto& [name, record] : files.items()) check(name, record);
  for (const Json& tile : manifest.at("tiles")) check(tile.at("file").get<std::string>(), tile);
  folder.remove_work();  // which may have been cut off
  finished = true;
}

TileRecord Store::Impl::tile_of(const std::string& line, const std::string& where) const {
  const Json json = unsealed(line, kTileSchema, where,
                             "Remove that journal: its tiles are computed again. " +
                                 std::string("--restart starts over."));
  if (json.at("plan") != plan_checksum) {
    throw Error(ErrorCode::usage, where + " is of another forest", kStartOver);
  }
  return tile_record(json);
}

std::map<TileId, TileRecord> Store::Impl::journalled() const {
  std::map<TileId, TileRecord> tiles;
  for (const fs::path& file : folder.journals()) {
    std::size_t number = 0;
    for (const std::string& line : whole_lines(file)) {
      const TileRecord tile =
          tile_of(line, file.string() + ", line " + std::to_string(++number) + ",");
      tiles.insert_or_assign(tile.id, tile);
    }
  }
  return tiles;
}

void Store::Impl::refresh() {
  if (finished) return;
  done = journalled();
  std::size_t lost = 0;
  fs::path first;
  std::erase_if(done, [&](const auto& entry) {
    const auto& [id, tile] = entry;
    const fs::path mesh = folder.mesh(id), seam = folder.seam(id);
    const bool has_mesh = is_there(mesh, tile.mesh);
    if (has_mesh && is_there(seam, tile.seam)) return false;
    if (lost++ == 0) first = has_mesh ? seam : mesh;
    return true;
  });
  if (lost == 0) return;
  warnings.push_back(
      std::to_string(lost) +
      (lost == 1 ? " tile is computed again: " : " tiles are computed again, one as ") +
      first.string() + " is missing or has another size than it had");
}

Store::Store(const fs::path& folder, const Json& plan, const std::string& writer, bool resume,
             bool restart) {
  check_writer(writer);
  impl_ = std::make_unique<Impl>(folder, plan, writer);
  impl_->open(resume, restart);
}
Store::~Store() = default;

const std::map<TileId, TileRecord>& Store::done() const { return impl_->done; }
std::optional<Json> Store::control() const {
  const fs::path file = impl_->folder.control();
  if (!fs::exists(file)) return std::nullopt;
  const Json kept = read_sealed(file, kControlSchema);
  if (kept.at("plan") != impl_->plan_checksum) {
    throw Error(ErrorCode::usage, file.string() + " is of another forest", kStartOver);
  }
  return kept.at("levels");
}

void Store::keep_control(const Json& levels) {
  const Json file =
      sealed({{"schema", kControlSchema}, {"plan", impl_->plan_checksum}, {"levels", levels}});
  impl_->folder.write_once(impl_->folder.control(), dumped(file, 2) + "\n");
}

void Store::refresh() { impl_->refresh(); }
bool Store::finished() const { return impl_->finished; }
bool Store::holds(const std::string& file) const { return impl_->files.contains(file); }
const std::vector<std::string>& Store::warnings() const { return impl_->warnings; }
const fs::path& Store::folder() const { return impl_->folder.path(); }
const std::string& Store::writer() const { return impl_->writer; }
const Json& Store::plan() const { return impl_->plan; }

TileRecord Store::put(const TileSurface& surface, TileRecord record) {
  const ForestFolder& folder = impl_->folder;
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
    record.mesh = folder.write(folder.mesh(record.id),
                               [&](std::ostream& stream) { write_glb(mesh, stream); });
  }
  record.seam = {};
  if (const Seam seam = seam_of(surface); !seam.empty()) {
    record.seam = folder.write(folder.seam(record.id),
                               [&](std::ostream& stream) { write_seam(seam, stream); });
  }
  const fs::path level = folder.mesh(record.id).parent_path();
  if (!record.mesh.sha256.empty() || !record.seam.sha256.empty()) {
    sync_folder(level);
    if (impl_->synced.insert(record.id.level).second) sync_folder(folder.work());
  }

  Json line{{"schema", kTileSchema}, {"plan", impl_->plan_checksum}};
  line.update(json_of(record));
  impl_->journal->append(dumped(sealed(std::move(line))));
  impl_->done.insert_or_assign(record.id, record);
  return record;
}

FileRecord put_file(const Store& store, const std::string& name,
                    const std::function<void(std::ostream&)>& writer) {
  const ForestFolder folder(store.folder(), store.writer());
  FileRecord record = folder.write(store.folder() / name, writer);
  sync_folder(store.folder());
  return record;
}

}  // namespace leafhull
