// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <initializer_list>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "cli/arguments.h"
#include "cli/values.h"

namespace CLI {
class App;
}

namespace leafhull::cli {

/// A command-line flag: the line of its row, and what the flag does.
struct Flag {
  OptionLine line;
  std::function<void(Arguments&, const std::string& value)> set;
  bool hidden = false;  ///< accepted, but listed in no table
};

/// The flags of all rows, or of one group, whose options `part` finds in the arguments.
template <class Struct, class... Members, class Part>
std::vector<Flag> flags_of(std::span<const RowOf<Struct, Members...>> rows, Part part,
                           std::string_view group = {}) {
  std::vector<Flag> flags;
  for (const auto& row : rows) {
    if (!group.empty() && row.group != group) continue;
    flags.push_back({row, [&row, part](Arguments& arguments, const std::string& text) {
                       set_value(std::invoke(part, arguments), row, {.line = row, .text = text});
                       arguments.given.insert(row.name);
                     }});
  }
  return flags;
}

/// The flags of options that only the command has.
std::vector<Flag> flags_of(std::span<const ArgumentRow> rows);

/// The rows of option_table(), or of one group of them.
std::vector<Flag> option_flags(std::string_view group = {});
/// The flags of a forest as a whole.
std::vector<Flag> forest_flags();
std::vector<Flag> render_flags();
std::vector<Flag> device_flags();
std::vector<Flag> console_flags();
std::vector<Flag> json_flags();
std::vector<Flag> help_flags();
std::vector<Flag> all_of(std::initializer_list<std::vector<Flag>> groups);

/// The words of a command, each flag joined with the word that may follow it.
std::vector<std::string> joined_words(std::vector<std::string> command,
                                      const std::vector<Flag>& flags);

/// Makes `app` understand the flags; they write to `arguments`, which outlives the parse.
void add_flags(CLI::App& app, const std::vector<Flag>& flags, Arguments& arguments);

}  // namespace leafhull::cli
