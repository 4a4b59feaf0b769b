// SPDX-License-Identifier: Apache-2.0
// Any bytes give either a scatter file whose trees can be placed, or an Error input. The reader
// only checks that a tree file exists, so the seeds name /dev/null.
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <sstream>
#include <string>

#include "input/file_bytes.h"
#include "promises.h"
#include "scene/scatter_file.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace leafhull::fuzz;
  return read_or_refuse([&] {
    std::istringstream text{std::string(leafhull::text_of({data, size}))};
    const leafhull::Scene scene = leafhull::read_csv_text(text, "fuzz.csv");
    require(!scene.trees.empty());
    for (const leafhull::PlacedTree& tree : scene.trees) {
      require(tree.model < scene.models.size());
      require(std::isfinite(tree.position.x) && std::isfinite(tree.position.y) &&
              std::isfinite(tree.position.z));
      for (const float entry : tree.linear) require(std::isfinite(entry));
    }
    for (const leafhull::SceneModel& model : scene.models) require_one_line(model.name);
    for (const std::string& warning : scene.warnings) require_one_line(warning);
  });
}
