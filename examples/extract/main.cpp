// SPDX-License-Identifier: Apache-2.0
// extract TREE SHAPE: the public API from a tree file to a shape file.
#include <leafhull/device.h>
#include <leafhull/error.h>
#include <leafhull/leaves.h>
#include <leafhull/options.h>
#include <leafhull/output.h>
#include <leafhull/shape.h>
#include <leafhull/tree.h>
#include <leafhull/version.h>

#include <filesystem>
#include <iostream>

int main(int argc, char** argv) {
  if (argc != 3) return 2;
  const std::filesystem::path tree_path = argv[1], shape_path = argv[2];
  try {
    leafhull::Options options;
    options.preset = leafhull::Preset::draft;

    const leafhull::OutputPlan plan = leafhull::plan_outputs({.shapes = {shape_path}}, tree_path);

    if (leafhull::list_devices({}).empty()) throw std::runtime_error("no OpenCL device is listed");
    leafhull::Device device(leafhull::DeviceOptions{});

    const leafhull::TreeModel tree = leafhull::read_tree(tree_path);
    const leafhull::LeafSet leaves = leafhull::find_leaves(tree, options.leaf_options());
    const leafhull::Shape shape = leafhull::extract(leaves, options, device);

    leafhull::write_outputs(plan, shape, {tree_path.string(), {"extract"}});

    std::cout << "leafhull " << leafhull::kVersion << ": " << leaves.leaf_count << " leaves, "
              << shape.mesh.triangles.size() << " triangles on " << shape.report.device << '\n';
    return shape.mesh.triangles.empty() || !std::filesystem::file_size(shape_path);
  } catch (const leafhull::Error& error) {
    std::cerr << error.what() << ' ' << error.remedy() << '\n';
    return static_cast<int>(error.code());
  } catch (const std::exception& error) {
    std::cerr << error.what() << '\n';
    return 1;
  }
}
