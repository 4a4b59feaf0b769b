// SPDX-License-Identifier: Apache-2.0
// Times pictures of a tree, from its leaves in memory to the picture in memory, warm; then once
// more with the subject ready, as for the next frame of a film.
#include <map>
#include <memory>
#include <numeric>
#include <optional>
#include <string>

#include "bench/contender.h"
#include "bench/leafhull_case.h"
#include "bench/threads.h"
#include "leafhull/device.h"
#include "leafhull/render.h"
#include "leafhull/version.h"
#include "picture/artist.h"

namespace leafhull::bench {
namespace {

struct Scene {
  std::shared_ptr<const TreeModel> tree;
  LeafSet leaves;
  Options options;
  Surfacing surfacing;
  PictureOptions picture;
  Device device;
};

/// Seconds by stage, without a total.
Json stages_of(const std::vector<StageTime>& seconds) {
  Json stages = Json::object();
  for (const StageTime& s : seconds) {
    if (s.stage != "total") stages[s.stage] = s.seconds;
  }
  return stages;
}

double sum_of(const Json& stages) {
  return std::accumulate(stages.begin(), stages.end(), 0.0,
                         [](double sum, const Json& s) { return sum + s.get<double>(); });
}

Json run(Scene& scene) {
  Artist artist(scene.device);
  std::optional<Subject> subject;
  Rendering rendering;
  const double total = seconds_of([&] {
    subject.emplace(
        tree_subject(scene.tree, scene.leaves, scene.options, scene.surfacing, scene.device));
    rendering = artist.draw(*subject, scene.picture);
  });
  Json stages = stages_of(subject->report()->seconds);
  const Json drawn = stages_of(rendering.seconds);
  stages["scene"] = total - sum_of(stages) - sum_of(drawn);  // wood, Embree, leaf cards
  stages.update(drawn);

  rendering = {};  // the next frame's memory is no more than the first's
  const double redraw = seconds_of([&] { rendering = artist.draw(*subject, scene.picture); });
  return {{"total", total},
          {"stages", stages},
          {"redraw_seconds", redraw},
          {"repaint_seconds", stages_of(rendering.seconds).at("paint")},
          {"on_gpu", scene.device.info().type == "GPU" ? 1 : 0}};
}

struct Asked {
  Surfacing surfacing = Surfacing::direct;
  Look look = Look::phong;
  int size = 1024;
};

Contender prepare(const Case& c, const Asked& asked, int threads) {
  DeviceOptions device;
  device.threads = threads;
  PictureOptions picture;
  picture.look = asked.look;
  picture.width = picture.height = asked.size;
  auto tree = std::make_shared<const TreeModel>(load_tree(c.tree));
  LeafSet leaves = find_leaves(*tree, {});
  const auto scene =
      std::make_shared<Scene>(std::move(tree), std::move(leaves), options_of(c, Method::controlled),
                              asked.surfacing, picture, Device(device));
  Contender contender{.name = "leafhull picture", .version = kVersion, .threads = threads};
  contender.run = [=, limit = limit_threads(threads)] { return run(*scene); };
  contender.setup["first run, kernels compiled"] = seconds_of(contender.run);
  return contender;
}

}  // namespace
}  // namespace leafhull::bench

int main(int argc, char** argv) {
  using namespace leafhull;
  CLI::App app("Pictures of a tree, warm.");
  bench::Asked asked;
  const std::map<std::string, Surfacing> surfacings = {{"direct", Surfacing::direct},
                                                       {"mesh", Surfacing::mesh}};
  const std::map<std::string, Look> looks = {{"phong", Look::phong},
                                             {"watercolour", Look::watercolour}};
  app.add_option("--surface", asked.surfacing)->transform(CLI::CheckedTransformer(surfacings));
  app.add_option("--look", asked.look)->transform(CLI::CheckedTransformer(looks));
  app.add_option("--size", asked.size, "pixels along each side")->check(CLI::PositiveNumber);
  return bench::serve(app, argc, argv, [&](const bench::Case& c, int threads) {
    return bench::prepare(c, asked, threads);
  });
}
