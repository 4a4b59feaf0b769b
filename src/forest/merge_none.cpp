// SPDX-License-Identifier: Apache-2.0
#include "forest/merge_none.h"

#include <string>

#include "forest/forest_identity.h"
#include "forest/instances.h"
#include "forest/store.h"
#include "leafhull/error.h"
#include "pipeline/memory.h"
#include "pipeline/stopwatch.h"
#include "tiles/level.h"

namespace leafhull {
namespace {

constexpr const char* kFile = "forest.glb";

/// A model's shape, without vertices where the model has no surface.
ModelShape shape_of(const SceneModel& model, const LeafSet& leaves, const Options& options,
                    Device& device, ForestSummary& summary) {
  try {
    Shape shape = extract(leaves, options, device, {}, Detail::shape);
    summary.mesh_vertices += shape.mesh.positions.size();
    summary.mesh_triangles += shape.mesh.triangles.size();
    return {model.name, std::move(shape.mesh)};
  } catch (const Error& error) {
    if (error.code() != ErrorCode::empty) throw;
    summary.warnings.push_back("the model " + model.name +
                               " has no surface and is left out: " + error.what());
    return {model.name, {}};
  }
}

}  // namespace

ForestSummary merge_none(const Scene& scene, const ForestOptions& options, Device& device,
                         Ranks& ranks, const std::filesystem::path& folder,
                         const Progress& progress) {
  const Progress none;
  Stopwatch watch(none);
  ForestSummary summary;
  summary.trees = scene.trees.size();
  summary.skipped = scene.skipped;
  const auto tell = [&](std::string_view stage, std::size_t done) {
    if (!progress) return;
    progress({.stage = stage,
              .done = static_cast<double>(done) / static_cast<double>(scene.models.size()),
              .finished = done,
              .all = scene.models.size(),
              .leaf_vertices = summary.leaf_vertices,
              .resident_bytes = resident_memory()});
  };
  if (ranks.rank() == 0) {
    watch.start("models");
    const std::vector<ModelUse> uses = model_uses(scene);
    const Options resolved = resolve(options.shape);
    const std::vector<LeafSet> models = read_models(scene, uses, resolved.leaf_options());
    Store store(folder, forest_identity(scene, models, options, device.info(), 0, 0), "rank-0",
                options.resume, options.restart);
    watch.start("shapes");
    std::vector<ModelShape> shapes(scene.models.size());
    bool any = false;
    for (std::size_t m = 0; m < models.size() && !store.finished(); ++m) {
      tell("shapes", m);
      if (uses[m].trees == 0) continue;
      ++summary.models;
      summary.leaf_vertices += uses[m].trees * models[m].vertices.size();
      for (const std::string& warning : models[m].warnings) summary.warnings.push_back(warning);
      shapes[m] = shape_of(scene.models[m], models[m], options.shape, device, summary);
      any = any || !shapes[m].mesh.positions.empty();
    }
    watch.start("write");
    tell("write", scene.models.size());
    if (!store.finished()) {
      if (!any) {
        store.folder().remove_work();
        throw Error(ErrorCode::empty, "the forest is empty: no model has a surface",
                    "Lower --threshold, enlarge --radius-max, or use a finer --resolution.");
      }
      const FileRecord file = put_file(store, kFile, [&](std::ostream& stream) {
        write_instances(shapes, scene.trees, stream);
      });
      finish_store(store, {}, {{kFile, file}});
    }
    summary.was_finished = store.finished();
    for (const std::string& warning : store.warnings()) summary.warnings.push_back(warning);
  }
  ranks.barrier();
  summary.peak_memory_bytes = peak_memory();
  summary.seconds = watch.finish();
  return summary;
}

}  // namespace leafhull
