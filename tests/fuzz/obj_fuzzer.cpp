// SPDX-License-Identifier: Apache-2.0
// As gltf_fuzzer.cpp, for OBJ. The material library follows a line "---MTL---".
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "input/obj.h"
#include "input/obj_text.h"
#include "promises.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  constexpr std::string_view kDivider = "\n---MTL---\n";
  const std::string_view input = leafhull::text_of({data, size});
  const std::size_t end = input.find(kDivider);
  return leafhull::fuzz::read_or_refuse([&] {
    leafhull::ObjMaterials materials;
    std::vector<std::string> warnings;
    if (end != std::string_view::npos) {
      materials.add_library(input.substr(end + kDivider.size()), "fuzz.mtl", warnings);
    }
    for (const std::string& warning : warnings) leafhull::fuzz::require_one_line(warning);
    leafhull::fuzz::check(leafhull::read_obj_text(leafhull::obj_text(input.substr(0, end)), "fuzz",
                                                  std::move(materials), {}));
  });
}
