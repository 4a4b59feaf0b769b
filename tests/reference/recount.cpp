// SPDX-License-Identifier: Apache-2.0
// Sums every kernel that leafhull used, by brute force in float64, and compares the results with
// leafhull's report. Shares no code with leafhull.
#include <cstdio>
#include <exception>
#include <fstream>
#include <stdexcept>
#include <string>
#include <vector>

#include "checks.h"

namespace {

constexpr const char* kUsage =
    "recount KERNELS.ply REPORT.json [SHAPE.ply] [--leaf-radii UNCONTROLLED_KERNELS.ply]";

nlohmann::json read_report(const std::string& path) {
  std::ifstream in(path);
  if (!in) throw std::runtime_error(path + ": cannot be opened");
  return nlohmann::json::parse(in);
}

recount::Extraction read_extraction(const std::vector<std::string>& arguments) {
  std::vector<std::string> files;
  std::optional<recount::Ply> leaf_kernels;
  for (std::size_t i = 0; i < arguments.size(); ++i) {
    if (arguments[i] == "--leaf-radii" && i + 1 < arguments.size()) {
      leaf_kernels = recount::read_ply(arguments[++i]);
    } else {
      files.push_back(arguments[i]);
    }
  }
  if (files.size() < 2 || files.size() > 3) throw std::invalid_argument(kUsage);
  recount::Extraction extraction{read_report(files[1]), recount::read_ply(files[0]), {}, {}};
  if (files.size() == 3) extraction.mesh = recount::read_ply(files[2]);
  if (leaf_kernels && leaf_kernels->vertex_count != extraction.kernels.vertex_count) {
    throw std::runtime_error("the two files of kernels are not of the same leaves");
  }
  extraction.leaf_kernels = std::move(leaf_kernels);
  if (extraction.kernels.vertex_count == 0) throw std::runtime_error("no kernels");
  return extraction;
}

}  // namespace

int main(int argc, char** argv) {
  try {
    const recount::Extraction extraction = read_extraction({argv + 1, argv + argc});
    recount::Table table;
    recount::check_kernels(extraction, table);
    recount::check_shape(extraction, table);
    table.print();
    return table.agrees() ? 0 : 1;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "recount: %s\n", error.what());
    return 2;
  }
}
