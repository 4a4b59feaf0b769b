// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <string_view>
#include <vector>

#include "cli/flags.h"

namespace leafhull::cli {

/// One of the command's verbs. `run` prints its results and throws Error where it fails.
struct Verb {
  std::string_view name, summary, about, examples;
  bool takes_tree = false;
  bool takes_trees = false;  ///< takes one or more trees
  std::string_view operand = "TREE", operand_help = "a .glb, .gltf, .fbx or .obj file",
                   operand_example = "tree.glb";
  std::span<const std::string_view> operand_words = {};  ///< the words it may be; empty: a file
  bool hidden = false;
  std::vector<Flag> flags;
  void (*run)(const Arguments&) = nullptr;

  bool takes_operand() const { return takes_tree || takes_trees; }
};

/// All verbs in the order in which they are listed.
std::vector<Verb> all_verbs();

/// The CMake option that adds a verb which this build leaves out; empty for any other word.
std::string_view option_that_brings(std::string_view verb);

Verb extract_verb();
Verb inspect_verb();
Verb sweep_verb();
Verb suggest_verb();
Verb study_verb();
Verb render_verb();
Verb forest_verb();
Verb scatter_verb();
Verb devices_verb();
Verb completion_verb();
Verb help_options_verb();
Verb help_forests_verb();
Verb help_pictures_verb();
Verb help_styles_verb();
Verb help_manual_verb();

}  // namespace leafhull::cli
