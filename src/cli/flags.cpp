// SPDX-License-Identifier: Apache-2.0
#include "cli/flags.h"

#include <CLI/CLI.hpp>
#include <cstddef>

#include "leafhull/error.h"
#include "leafhull/version.h"

namespace leafhull::cli {
namespace {

std::string with_word(const OptionLine& line) {
  return line.spelling + "-" + std::string(line.word);
}

}  // namespace

std::vector<Flag> flags_of(std::span<const ArgumentRow> rows) {
  return flags_of(rows, [](Arguments& arguments) -> Arguments& { return arguments; });
}

std::vector<Flag> option_flags(std::string_view group) {
  std::vector<Flag> flags;
  for (const OptionRow& row : option_table()) {
    if (!group.empty() && row.group != group) continue;
    flags.push_back({row, [&row](Arguments& arguments, const std::string& text) {
                       set_option(arguments.options, row, text);
                       arguments.given.insert(row.name);
                       const std::string value = text.empty() ? "" : " " + quoted(text);
                       arguments.typed += " " + row.spelling + value;
                     }});
  }
  return flags;
}

std::vector<Flag> device_flags() { return flags_of(device_table(), &Arguments::device); }

std::vector<Flag> console_flags() {
  static const ArgumentRow rows[] = {
      ArgumentRow("General", "quiet", &Arguments::quiet, "prints errors only", {.letter = 'q'}),
      ArgumentRow("General", "verbose", &Arguments::verbose,
                  "prints what was found and how long each stage took", {.letter = 'v'}),
  };
  return flags_of(rows);
}

std::vector<Flag> json_flags() {
  static const ArgumentRow rows[] = {
      ArgumentRow("General", "json", &Arguments::json, "prints JSON instead of a table")};
  return flags_of(rows);
}

std::vector<Flag> help_flags() {
  return {{OptionLine("General", "help", {}, "prints this page", {.letter = 'h'}),
           [](Arguments&, const std::string&) { throw CLI::CallForHelp(); }},
          {OptionLine("General", "version", {}, "prints the version", {}),
           [](Arguments&, const std::string&) {
             throw CLI::CallForVersion("leafhull " + std::string(kVersion), 0);
           }}};
}

std::vector<Flag> all_of(std::initializer_list<std::vector<Flag>> groups) {
  std::vector<Flag> flags;
  for (const auto& group : groups) flags.insert(flags.end(), group.begin(), group.end());
  return flags;
}

std::vector<std::string> joined_words(std::vector<std::string> command,
                                      const std::vector<Flag>& flags) {
  for (const Flag& flag : flags) {
    if (flag.line.word.empty()) continue;
    for (std::size_t i = 1; i < command.size(); ++i) {
      if (command[i - 1] != flag.line.spelling || command[i] != flag.line.word) continue;
      command[i - 1] = with_word(flag.line);
      command.erase(command.begin() + static_cast<std::ptrdiff_t>(i));
    }
  }
  return command;
}

void add_flags(CLI::App& app, const std::vector<Flag>& flags, Arguments& arguments) {
  app.set_help_flag();
  for (const Flag& flag : flags) {
    const OptionLine& line = flag.line;
    if (line.value.empty()) {
      app.add_flag_callback(line.spelling, [&flag, &arguments] { flag.set(arguments, {}); });
      if (line.word.empty()) continue;
      app.add_flag_callback(with_word(line), [&flag, &arguments] {
        flag.set(arguments, std::string(flag.line.word));
      });
      continue;
    }
    app.add_option_function<std::vector<std::string>>(
           line.spelling,
           [&flag, &arguments](const std::vector<std::string>& values) {
             if (values.size() > 1 && !flag.line.repeatable) {
               throw Error(ErrorCode::usage, flag.line.spelling + " is given more than once",
                           "Give it once.");
             }
             for (const std::string& value : values) flag.set(arguments, value);
           })
        ->allow_extra_args(false);
  }
}

}  // namespace leafhull::cli
