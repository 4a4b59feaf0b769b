// SPDX-License-Identifier: Apache-2.0
#include "bench/leafhull_case.h"

#include <charconv>
#include <map>
#include <string_view>

#include "bench/synthetic_crown.h"
#include "leafhull/error.h"

namespace leafhull::bench {

TreeModel load_tree(const std::string& tree) {
  constexpr std::string_view kSynthetic = "synthetic:";
  if (!tree.starts_with(kSynthetic)) return read_tree(tree);
  std::size_t count = 0;
  const char* end = tree.data() + tree.size();
  const auto [p, error] = std::from_chars(tree.data() + kSynthetic.size(), end, count);
  if (error != std::errc{} || p != end) {
    throw Error(ErrorCode::usage, "'" + tree + "' names no number of leaf vertices",
                "Give synthetic:COUNT.");
  }
  return synthetic_crown(count);
}

LeafSet load_leaves(const std::string& tree) { return find_leaves(load_tree(tree), {}); }

Options options_of(const Case& c, Method method) {
  Options options;
  options.method = method;
  options.points = PointSource::vertices;  // as its peers take them
  options.threshold = c.threshold;
  options.coverage = c.coverage;
  options.radius_max = c.radius;
  options.radius_unit = RadiusUnit::model;
  options.flatness = c.flatness;
  options.min_component = c.min_component;
  options.voxel_size = c.voxel;
  return resolve(options);
}

void add_method(CLI::App& app, Method& method) {
  const std::map<std::string, Method> methods = {{"isotropic", Method::isotropic},
                                                 {"controlled", Method::controlled}};
  app.add_option("--method", method)->transform(CLI::CheckedTransformer(methods));
}

}  // namespace leafhull::bench
