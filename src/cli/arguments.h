// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "leafhull/device.h"
#include "leafhull/forest.h"
#include "leafhull/options.h"
#include "leafhull/output.h"
#include "leafhull/render.h"
#include "leafhull/scene.h"
#include "leafhull/sweep.h"

namespace leafhull::cli {

/// What a command line asks for.
struct Arguments {
  std::vector<std::string> command;  ///< the words as typed
  std::filesystem::path tree;
  Options options;
  std::set<std::string_view> given;  ///< names of typed options, as option_table() has them
  std::string typed;                 ///< the options again, quoted for a shell
  OutputFiles files;
  DeviceOptions device;
  bool quiet = false, verbose = false;
  bool json = false;

  // sweep
  std::vector<SweptOption> swept;  ///< more than one value each
  bool yes = false, restart = false;

  std::filesystem::path picture;  ///< suggest

  // render
  std::string camera = "three-quarter", watercolour_style;
  PictureOptions drawing;
  PictureFiles pictures;
  std::optional<Surfacing> surfacing;
  std::optional<double> detail;
  std::optional<bool> is_shape;
  bool beside = false;
  std::optional<Plate> figure17;

  // scatter
  ScatterOptions scatter;
  std::filesystem::path scatter_file;

  // forest
  ForestOptions forest;

  // study
  std::vector<std::filesystem::path> trees;
  std::filesystem::path folder;
};

}  // namespace leafhull::cli
