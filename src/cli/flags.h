// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <initializer_list>
#include <string>
#include <string_view>
#include <vector>

#include "cli/arguments.h"

namespace CLI {
class App;
}

namespace leafhull::cli {

/// A flag of the command line and its line of help.
struct Flag {
  std::string spelling;         ///< "-o,--output"
  std::string_view value = "";  ///< "FILE"; empty: the flag takes none
  std::string_view word = "";   ///< what may follow a flag that takes no other value
  std::string_view group;
  std::string_view unit = "", range = "", default_value = "";
  std::string_view help;
  bool repeatable = false;
  bool hidden = false;  ///< understood, and in no table
  std::function<void(Arguments&, const std::string& value)> set;
};

/// An option's flag: --no-snap of `snap`, which is on without it.
std::string spelling(const OptionRow& row);

/// The words of a command, each flag made one with the word that may follow it.
std::vector<std::string> joined_words(std::vector<std::string> command,
                                      const std::vector<Flag>& flags);

/// The rows of option_table(), or of one group of them.
std::vector<Flag> option_flags(std::string_view group = {});
/// The same, several values at once where a sweep takes them.
std::vector<Flag> swept_flags();
std::vector<Flag> output_flags();
std::vector<Flag> sweep_flags();
std::vector<Flag> suggest_flags();
std::vector<Flag> render_flags();
/// Those of a forest as a whole.
std::vector<Flag> forest_flags();
/// The options of its trees; those that tiles cannot have are refused with the reason.
std::vector<Flag> tree_flags();
std::vector<Flag> device_flags();
std::vector<Flag> console_flags();
std::vector<Flag> json_flags();
std::vector<Flag> help_flags();
std::vector<Flag> all_of(std::initializer_list<std::vector<Flag>> groups);

/// Makes `app` understand the flags; they write to `arguments`, which outlives the parse.
void add_flags(CLI::App& app, const std::vector<Flag>& flags, Arguments& arguments);

}  // namespace leafhull::cli
