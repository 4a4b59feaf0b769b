// SPDX-License-Identifier: Apache-2.0
#include <CLI/CLI.hpp>
#include <array>
#include <iostream>
#include <memory>
#include <string>
#include <vector>

#include "leafhull/error.h"
#include "leafhull/leaves.h"
#include "leafhull/picture.h"
#include "leafhull/tree.h"
#include "output/transaction.h"
#include "render/camera.h"
#include "render/painter.h"
#include "render/scene.h"
#include "render/surface.h"

namespace leafhull::render {
namespace {

struct Arguments {
  std::string tree, shape, picture;
  std::array<int, 2> size{1600, 1000};
  int samples = 16;
  std::vector<std::string> leaves;
};

/// For every instance whether it is leaves.
std::vector<bool> are_leaves(const TreeModel& tree, const std::vector<std::string>& globs) {
  LeafOptions options;
  options.globs = globs;
  const LeafChoice choice = choose_leaves(tree, options);
  if (!choice.any()) {
    throw Error(ErrorCode::input, tree.path.string() + ": no leaves found",
                "Name them with --leaves GLOB, as for leafhull extract.");
  }
  return choice.instances;
}

/// The tree's box standing on the foot of its wood at the origin, its longest side 1.
Placement place(const TreeModel& tree, const std::vector<bool>& leaves) {
  Box box, wood;
  for (std::size_t i = 0; i < tree.instances.size(); ++i) {
    for (const Vec3d p : world_positions(tree, tree.instances[i])) {
      box.include(p);
      if (!leaves[i]) wood.include(p);
    }
  }
  if (!(box.longest_side() > 0)) {
    throw Error(ErrorCode::input, tree.path.string() + ": nothing to draw",
                "Give a tree that has triangles.");
  }
  const Vec3d middle = (box.low + box.high) / 2;
  return {{middle.x, (wood.empty() ? box : wood).low.y, middle.z}, 1 / box.longest_side()};
}

void preview(const Arguments& arguments) {
  const TreeModel tree = read_tree(arguments.tree);
  const TreeModel shape = read_tree(arguments.shape);
  const std::vector<bool> leaves = are_leaves(tree, arguments.leaves);
  const Placement placement = place(tree, leaves);

  const DeviceHandle embree = open_embree();
  std::vector<std::shared_ptr<const Surface>> tree_surfaces, shape_surfaces;
  std::vector<Vec3f> points;
  const auto add = [&](const TreeModel& model, const Instance& instance, Look look) {
    if (model.primitives[instance.primitive].triangles.empty()) return;
    for (const Vec3d p : world_positions(model, instance)) points.push_back(placement(p));
    auto surface = make_surface(embree.get(), model, instance, look, placement);
    if (look != Look::shape) tree_surfaces.push_back(surface);
    if (look != Look::leaf) shape_surfaces.push_back(surface);
  };
  for (std::size_t i = 0; i < tree.instances.size(); ++i) {
    add(tree, tree.instances[i], leaves[i] ? Look::leaf : Look::wood);
  }
  for (const Instance& instance : shape.instances) add(shape, instance, Look::shape);

  const auto [width, height] = arguments.size;
  Picture picture{width, height, {}};
  picture.rgb.resize(std::size_t{3} * width * height);
  const Camera camera = frame(points, width / 2 / static_cast<float>(height));
  draw(Scene(embree.get(), tree_surfaces), camera, arguments.samples, 0, width / 2, picture);
  draw(Scene(embree.get(), shape_surfaces), camera, arguments.samples, width / 2, width - width / 2,
       picture);

  const std::vector<std::uint8_t> png = encode_png(picture);
  Transaction files;
  files.write(arguments.picture, [&](std::ostream& file) {
    file.write(reinterpret_cast<const char*>(png.data()), static_cast<std::streamsize>(png.size()));
  });
  files.commit();
}

int run(int argc, char** argv) {
  Arguments arguments;
  CLI::App app("Draws a tree and, beside it, its abstract shape.", "leafhull-preview");
  app.add_option("TREE", arguments.tree, "the tree: .glb, .gltf or .obj")->required();
  app.add_option("SHAPE", arguments.shape, "its shape, from `leafhull extract`")->required();
  app.add_option("-o", arguments.picture, "the picture: .png")->required();
  app.add_option("--size", arguments.size, "width and height in pixels, as in 1600x1000")
      ->delimiter('x')
      ->check(CLI::Range(16, 16384));
  app.add_option("--samples", arguments.samples, "rays per pixel")
      ->capture_default_str()
      ->check(CLI::Range(1, 4096));
  app.add_option("--leaves", arguments.leaves, "which names are leaves, as in `leafhull extract`")
      ->allow_extra_args(false);
  try {
    app.parse(argc, argv);
    preview(arguments);
    return 0;
  } catch (const CLI::Success& done) {
    return app.exit(done);
  } catch (const CLI::ParseError& error) {
    std::cerr << "leafhull-preview: " << error.what() << ". See leafhull-preview --help\n";
    return static_cast<int>(ErrorCode::usage);
  } catch (const Error& error) {
    std::cerr << "leafhull-preview: " << error.what();
    if (!error.remedy().empty()) std::cerr << ". " << error.remedy();
    std::cerr << '\n';
    return static_cast<int>(error.code());
  } catch (const std::exception& error) {
    std::cerr << "leafhull-preview: " << error.what() << '\n';
    return static_cast<int>(ErrorCode::internal);
  }
}

}  // namespace
}  // namespace leafhull::render

int main(int argc, char** argv) { return leafhull::render::run(argc, argv); }
