// SPDX-License-Identifier: Apache-2.0
// A forest from its scene to the folder that holds it.
#include <algorithm>
#include <array>
#include <atomic>
#include <chrono>
#include <future>
#include <mutex>
#include <optional>
#include <semaphore>
#include <string>
#include <utility>

#include "density/control.h"
#include "forest/forest_folder.h"
#include "forest/forest_identity.h"
#include "forest/merge_none.h"
#include "forest/store.h"
#include "forest/tileset.h"
#include "leafhull/error.h"
#include "leafhull/forest.h"
#include "leafhull/ranks.h"
#include "pipeline/memory.h"
#include "pipeline/stopwatch.h"
#include "text/file_name.h"
#include "tiles/compute_tile.h"
#include "tiles/scene_control.h"
#include "tiles/tile_count.h"
#include "tiles/tile_plan.h"

namespace leafhull {
namespace {

/// Calls visit(name, number) for each number that control over the scene finds for a level.
template <class Level, class Visit>
void for_each_found(Level& level, const Visit& visit) {
  visit("mean", level.scene_statistics->mean);
  visit("variance", level.scene_statistics->variance);
  visit("p1", level.scene_statistics->p1);
  visit("p2", level.scene_statistics->p2);
  visit("threshold", level.threshold);
}

/// A tile of one of the levels.
struct Work {
  const ForestLevel* level;
  TileTask task;
  double weight;
};

/// All of a forest that does not change while its tiles are computed.
struct Forest {
  std::vector<ForestLevel> levels;
  int edge = 0;
  std::vector<TilePlan> plans;

  std::vector<TileId> tiles() const {
    std::vector<TileId> all;
    for (const TilePlan& plan : plans)
      all.insert(all.end(), plan.tiles().begin(), plan.tiles().end());
    return all;
  }

  /// The work, heavy tiles first, so that none is left over when the others are done.
  std::vector<Work> work() const {
    std::vector<Work> all;
    for (std::size_t l = 0; l < plans.size(); ++l) {
      for (std::size_t t = 0; t < plans[l].size(); ++t) {
        all.push_back({&levels[l], plans[l].task(t), plans[l].weight(t)});
      }
    }
    std::stable_sort(all.begin(), all.end(),
                     [](const Work& a, const Work& b) { return a.weight > b.weight; });
    return all;
  }
};

using Computing = std::counting_semaphore<kTilesAtOnce>;

/// Permission to compute a tile; a few tiles may be computed at once.
class Permit {
 public:
  explicit Permit(Computing& computing) : computing_(computing) { computing_.acquire(); }
  ~Permit() { computing_.release(); }
  Permit(const Permit&) = delete;
  Permit& operator=(const Permit&) = delete;

 private:
  Computing& computing_;
};

class Run {
 public:
  Run(const Scene& scene, const ForestOptions& options, Device& device, Ranks& ranks,
      const std::filesystem::path& folder, const Progress& progress)
      : scene_(scene),
        options_(options),
        device_(device),
        ranks_(ranks),
        folder_(folder),
        progress_(progress) {}

  ForestSummary canopy() {
    prepare();
    if (!open_store()) return summary();
    if (options_.control_scope == ControlScope::scene && !restore_control()) {
      if (options_.finish) {
        for (ForestLevel& level : forest_.levels) level.threshold = NAN;  // no part has run
      } else {
        control();
      }
    }
    if (!options_.finish) compute();
    ranks_.barrier();
    store_->refresh();
    count_tiles();
    if (!options_.range) finish();
    ranks_.barrier();
    return summary();
  }

 private:
  void tell(std::string_view stage) { tell(stage, 0, 0); }
  void tell(std::string_view stage, std::size_t done, std::size_t all) {
    if (!progress_) return;
    progress_({.stage = stage,
               .done = all > 0 ? static_cast<double>(done) / static_cast<double>(all) : 0,
               .finished = done,
               .all = all,
               .leaf_vertices = leaf_vertices_,
               .resident_bytes = resident_memory()});
  }

  void prepare() {
    watch_.start("models");
    tell("models");
    const Options resolved = resolved_shape(options_);
    const std::vector<ModelUse> uses = model_uses(scene_);
    const std::vector<LeafSet> models = read_models(scene_, uses, resolved.leaf_options());
    const std::vector<Options> shapes = shapes_of(models, uses, resolved, device_);
    const double voxel_size = voxel_size_of(models, uses, shapes);
    check_tile_count(scene_, models, shapes, voxel_size, options_.tile.value_or(kTileEdge),
                     folder_);
    for (int l = 0; l < options_.levels; ++l) {
      const ForestLevel* finest = l > 0 ? &forest_.levels.front() : nullptr;
      ForestLevel level = prepare_level(l, scene_, models, shapes, voxel_size, finest, device_);
      level.scope = options_.control_scope;
      forest_.levels.push_back(std::move(level));
    }
    for (std::size_t m = 0; m < models.size(); ++m) {
      summary_.leaf_vertices += uses[m].trees * models[m].vertices.size();
      summary_.models += uses[m].trees > 0;
      for (const std::string& warning : models[m].warnings) summary_.warnings.push_back(warning);
    }
    watch_.start("plan");
    tell("plan");
    forest_.edge = tile_edge(forest_.levels, options_.tile, options_.memory.bytes, folder_);
    for (const ForestLevel& level : forest_.levels) {
      forest_.plans.emplace_back(level, forest_.edge);
    }
    // This computes surfaces, so what cannot be made has been refused before.
    for (ForestLevel& level : forest_.levels) level.least = least_volume(level, uses, device_);
    identity_ = forest_identity(scene_, models, options_, device_.info(), voxel_size, forest_.edge);
  }

  /// Returns false where the forest is already finished.
  bool open_store() {
    const std::string writer = options_.range ? "part-" + std::to_string(options_.range->part) +
                                                    "-of-" + std::to_string(options_.range->parts)
                                              : "rank-" + std::to_string(ranks_.rank());
    // The first makes or clears the folder; the others, and parts of a farm's run, join it.
    const bool joins = options_.range || options_.finish || ranks_.rank() > 0;
    if (ranks_.rank() > 0) ranks_.barrier();
    store_.emplace(folder_, identity_, writer, options_.resume || joins,
                   options_.restart && !joins);
    if (ranks_.rank() == 0) ranks_.barrier();
    summary_.was_finished = store_->finished();
    if (summary_.was_finished && options_.single && !store_->holds(options_.single->string())) {
      throw Error(ErrorCode::usage,
                  folder_.string() + " already holds this forest, finished, without " +
                      options_.single->string(),
                  "--restart starts over.");
    }
    return !summary_.was_finished;
  }

  void control() {
    watch_.start("control");
    const auto advance = [&](std::size_t done, std::size_t all) { tell("control", done, all); };
    for (std::size_t l = 0; l < forest_.levels.size(); ++l) {
      const ForestLevel* finest = l > 0 ? &forest_.levels.front() : nullptr;
      control_over_scene(forest_.plans[l], finest, forest_.levels[l], device_, ranks_, advance);
    }
    if (ranks_.rank() != 0) return;
    Json levels = Json::array();
    for (const ForestLevel& level : forest_.levels) {
      Json& kept = levels.emplace_back();
      for_each_found(level, [&](const char* name, double found) { kept[name] = found; });
    }
    store_->keep_control(levels);
  }

  /// Takes the control that an earlier run or another part has kept; false where there is none.
  bool restore_control() {
    // Rank 0 decides, so that all ranks go the same way.
    const std::optional<Json> mine = ranks_.rank() == 0 ? store_->control() : std::nullopt;
    const std::string kept = ranks_.all(mine ? dumped(*mine) : "").front();
    if (kept.empty()) return false;
    const Json levels = Json::parse(kept);
    for (std::size_t l = 0; l < forest_.levels.size(); ++l) {
      forest_.levels[l].scene_statistics.emplace();
      for_each_found(forest_.levels[l],
                     [&](const char* name, double& found) { levels.at(l).at(name).get_to(found); });
    }
    return true;
  }

  /// The tiles of this run that are not on the disk, heavy ones first.
  std::vector<Work> work_to_do() {
    std::vector<Work> work = forest_.work();
    if (options_.range) {
      const auto parts = static_cast<std::size_t>(options_.range->parts);
      std::vector<Work> mine;
      for (auto i = static_cast<std::size_t>(options_.range->part - 1); i < work.size();
           i += parts) {
        mine.push_back(work[i]);
      }
      work = std::move(mine);
    }
    all_ = work.size();
    std::erase_if(work, [&](const Work& w) { return store_->done().contains(w.task.id); });
    return work;
  }

  void compute() {
    watch_.start("tiles");
    const std::vector<Work> work = work_to_do();
    summary_.resumed = all_ - work.size();
    if (ranks_.rank() == 0) ranks_.add(Sum::tiles, summary_.resumed);
    ranks_.reset();
    tell("tiles", summary_.resumed, all_);
    // One tile is written while others are computed: two at once, as some steps take one thread
    // and would leave cores idle.
    Computing computing(device_.may_overlap() ? kTilesAtOnce : 1);
    std::atomic<bool> failed = false;
    const auto take_tiles = [&] {
      try {
        for (auto i = next_of(work); i && !failed; i = next_of(work)) {
          make_tile(work[*i], computing);
        }
      } catch (...) {
        failed = true;
        throw;
      }
    };
    std::array<std::future<void>, kTilesAtOnce> others;
    for (auto& other : others) other = std::async(std::launch::async, take_tiles);
    take_tiles();
    for (auto& other : others) other.get();
  }

  std::optional<std::size_t> next_of(const std::vector<Work>& work) {
    const std::lock_guard alone(sharing_);
    const std::uint64_t i = ranks_.next();
    return i < work.size() ? std::optional<std::size_t>(i) : std::nullopt;
  }

  void make_tile(const Work& work, Computing& computing) {
    TileRecord record(work.task.id);
    record.rank = ranks_.rank();
    const TileSurface surface = [&] {
      const Permit permit(computing);
      const auto start = std::chrono::steady_clock::now();
      TileSurface computed = compute_tile(*work.level, work.task, device_);
      const std::chrono::duration<double> elapsed = std::chrono::steady_clock::now() - start;
      record.seconds = elapsed.count();
      record.resident_bytes = resident_memory();
      return computed;
    }();
    {
      const std::lock_guard alone(storing_);
      store_->put(surface, record);
    }
    const std::lock_guard alone(sharing_);
    leaf_vertices_ = ranks_.add(Sum::leaf_vertices, surface.leaf_vertices);
    tell("tiles", ranks_.add(Sum::tiles, 1), all_);
  }

  void count_tiles() {
    summary_.tiles = forest_.tiles().size();
    for (const auto& [id, record] : store_->done()) {
      summary_.empty += record.triangles == 0;
      summary_.rows.push_back(record);
    }
    summary_.remaining = summary_.tiles - std::min(summary_.tiles, store_->done().size());
  }

  void finish() {
    if (summary_.remaining > 0) {
      throw Error(ErrorCode::usage,
                  std::to_string(summary_.remaining) + " of " + std::to_string(summary_.tiles) +
                      " tiles are still to do in " + folder_.string(),
                  "Run the missing --tile-range parts, or continue with --resume.");
    }
    watch_.start("finish");
    tell("finish", summary_.tiles, summary_.tiles);
    if (ranks_.rank() != 0) return;
    if (summary_.empty == summary_.tiles) refuse_empty();
    SmallPieces small;
    for (const ForestLevel& level : forest_.levels) small.least.push_back(level.least);
    const std::vector<TileId> tiles = forest_.tiles();
    const FinishedForest finished =
        put_in_place(*store_, tiles, forest_.edge, small, options_.single);
    if (finished.tiles.empty()) refuse_empty();
    std::vector<double> errors;
    for (const ForestLevel& level : forest_.levels) errors.push_back(level.error);
    const std::string tileset = tileset_json(finished.tiles, errors);
    std::map<std::string, FileRecord> files{
        {"tileset.json",
         put_file(*store_, "tileset.json", [&](std::ostream& stream) { stream << tileset; })}};
    if (finished.single) files.emplace(options_.single->string(), *finished.single);
    finish_store(*store_, finished.tiles, files);
    for (const TileRecord& tile : finished.tiles) {
      summary_.mesh_vertices += tile.vertices;
      summary_.mesh_triangles += tile.triangles;
    }
  }

  [[noreturn]] void refuse_empty() {
    const bool surface = std::ranges::any_of(store_->done(), [](const auto& tile) {
      return tile.second.triangles > 0 || tile.second.dropped_components > 0;
    });
    store_->folder().remove_work();
    if (surface) {
      throw Error(ErrorCode::empty, "the forest is empty: every piece of its surface is small",
                  "Lower --min-component.");
    }
    throw Error(ErrorCode::empty,
                "the forest is empty: no tree reaches the threshold at this voxel size",
                "Lower --threshold or --voxel-size, or enlarge --radius-max.");
  }

  ForestSummary summary() {
    summary_.trees = scene_.trees.size();
    summary_.skipped = scene_.skipped;
    for (const ForestLevel& level : forest_.levels) {
      summary_.levels.push_back({.level = level.level,
                                 .voxel_size = level.voxel_size,
                                 .threshold = level.threshold,
                                 .error = level.error});
    }
    for (const std::string& warning : store_->warnings()) summary_.warnings.push_back(warning);
    for (const std::string& peak : ranks_.all(std::to_string(peak_memory()))) {
      summary_.peak_memory_bytes =
          std::max<std::uint64_t>(summary_.peak_memory_bytes, std::stoull(peak));
    }
    summary_.seconds = watch_.finish();
    return std::move(summary_);
  }

  const Scene& scene_;
  const ForestOptions& options_;
  Device& device_;
  Ranks& ranks_;
  const std::filesystem::path& folder_;
  const Progress& progress_;
  const Progress no_progress_;
  Stopwatch watch_{no_progress_};
  Forest forest_;
  Json identity_;
  std::optional<Store> store_;
  std::mutex storing_;  ///< held to put a tile into the store
  std::mutex sharing_;  ///< held to talk to the other ranks and the user
  ForestSummary summary_;
  std::size_t all_ = 0;  ///< tiles of this run
  std::uint64_t leaf_vertices_ = 0;
};

/// Checks that the forest does not overwrite its trees.
void check_models(const Scene& scene, const ForestPlan& plan) {
  const OutputFolder& folder = plan.folder();
  for (const SceneModel& model : scene.models) {
    if (model.file.empty()) continue;
    check_name(model.file, "the model", folder.path());
    if (!plan.single()) continue;
    const std::filesystem::path& single = plan.single()->path();
    (void)folder.file(single, lower_extension(single), {model.file});
  }
}

}  // namespace

ForestSummary run_forest(const Scene& scene, const ForestPlan& plan, Device& device, Ranks& ranks,
                         const Progress& progress) {
  check_models(scene, plan);
  const ForestOptions& options = plan.options();
  const std::filesystem::path& folder = plan.folder().path();
  const ThreadLimit limit(device.threads());
  const bool is_new = !std::filesystem::exists(folder);
  try {
    if (options.merge == Merge::none) {
      return merge_none(scene, options, device, ranks, folder, progress);
    }
    return Run(scene, options, device, ranks, folder, progress).canopy();
  } catch (const Error&) {
    std::error_code not_empty;
    if (is_new) std::filesystem::remove(folder, not_empty);
    throw;
  }
}

}  // namespace leafhull
