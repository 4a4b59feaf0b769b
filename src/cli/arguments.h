// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "leafhull/device.h"
#include "leafhull/forest.h"
#include "leafhull/option_row.h"
#include "leafhull/options.h"
#include "leafhull/output.h"
#include "leafhull/render.h"
#include "leafhull/scene.h"
#include "leafhull/sweep.h"

namespace leafhull::cli {

/// What a command line has asked for.
struct Arguments {
  std::vector<std::string> command;          ///< the words as typed
  std::filesystem::path operand;             ///< a verb's only operand: a tree, a scene, a shell
  std::vector<std::filesystem::path> trees;  ///< the operands of a verb that takes several
  std::set<std::string_view> given;          ///< names of typed options, as their rows have them

  Options options;
  std::string typed;  ///< the options again, quoted for a shell
  OutputFiles files;
  std::filesystem::path output;  ///< the one file or folder that other verbs write
  RenderOptions render;
  ForestOptions forest;
  ScatterOptions scatter;
  std::vector<SweptOption> swept;  ///< options with more than one value
  bool yes = false, restart = false;

  DeviceOptions device;
  bool quiet = false, verbose = false;
  bool json = false;
};

/// A row of an option that only the command has.
using ArgumentRow = RowOver<Arguments, bool, std::filesystem::path>;

}  // namespace leafhull::cli
