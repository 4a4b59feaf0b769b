// SPDX-License-Identifier: Apache-2.0
#include "cli/flags.h"

#include <CLI/CLI.hpp>
#include <optional>
#include <type_traits>

#include "cli/values.h"
#include "leafhull/error.h"
#include "leafhull/version.h"

namespace leafhull::cli {
namespace {

constexpr std::string_view kVariants[] = {"vector", "work-item"};
constexpr int kMostThreads = 1024;

std::string_view metavar_of(bool) { return ""; }
std::string_view metavar_of(int) { return "N"; }
std::string_view metavar_of(double) { return "X"; }
std::string_view metavar_of(const std::vector<std::string>&) { return "GLOB"; }
std::string_view metavar_of(const TextureEllipse&) { return "cu,cv,au,av,bu,bv"; }
std::string_view metavar_of(const LeafColour&) { return "COLOUR"; }
std::string_view metavar_of(const Srgb&) { return "COLOUR"; }

template <class Enum>
requires std::is_enum_v<Enum> std::string_view metavar_of(Enum) { return "NAME"; }

template <class Value>
std::string_view metavar_of(const std::optional<Value>&) {
  return metavar_of(Value{});
}

std::string_view metavar(const OptionRow& row) {
  return std::visit([](auto member) { return metavar_of(Options{}.*member); }, row.member);
}

Flag option_flag(const OptionRow& row) {
  return {.spelling = spelling(row),
          .value = metavar(row),
          .group = row.group,
          .unit = row.unit,
          .range = row.range,
          .default_value = row.default_value,
          .help = row.help,
          .repeatable = std::holds_alternative<std::vector<std::string> Options::*>(row.member),
          .set = [&row](Arguments& arguments, const std::string& text) {
            set_option(arguments.options, row, text);
            arguments.given.insert(row.name);
            const std::string value = text.empty() ? "" : " " + quoted(text);
            arguments.typed += " " + spelling(row) + value;
          }};
}

std::string with_word(const Flag& flag) { return flag.spelling + "-" + std::string(flag.word); }

void set_values(Arguments& arguments, const OptionRow& row, const std::string& text) {
  const SweptOption option = swept_option(row, text);
  if (option.values.size() == 1 && option.values.front() == text) {
    set_option(arguments.options, row, text);
  } else {
    arguments.swept.push_back(option);
  }
  arguments.given.insert(row.name);
}

}  // namespace

std::string spelling(const OptionRow& row) {
  const auto* flag = std::get_if<bool Options::*>(&row.member);
  const bool on = flag != nullptr && Options{}.**flag;
  return (on ? "--no-" : "--") + std::string(row.name);
}

std::vector<Flag> option_flags(std::string_view group) {
  std::vector<Flag> flags;
  for (const OptionRow& row : option_table()) {
    if (group.empty() || row.group == group) flags.push_back(option_flag(row));
  }
  return flags;
}

std::vector<Flag> swept_flags() {
  std::vector<Flag> flags;
  for (const OptionRow& row : option_table()) {
    flags.push_back(option_flag(row));
    if (!can_sweep(row)) continue;
    flags.back().set = [&row](Arguments& a, const std::string& text) { set_values(a, row, text); };
  }
  return flags;
}

std::vector<Flag> output_flags() {
  return {
      {.spelling = "-o,--output",
       .value = "FILE",
       .group = "Output",
       .range = ".glb .gltf .obj .ply .stl .vdb",
       .default_value = "none",
       .help = "the shape, in the format of the extension; repeatable",
       .repeatable = true,
       .set = [](Arguments& a, const std::string& text) { a.files.shapes.emplace_back(text); }},
      {.spelling = "--save-kernels",
       .value = "FILE",
       .group = "Output",
       .range = ".ply",
       .default_value = "none",
       .help = "a point per kernel with its axes, radii and density",
       .set = [](Arguments& a, const std::string& text) { a.files.kernels = text; }},
      {.spelling = "--save-field",
       .value = "FILE",
       .group = "Output",
       .range = ".vdb",
       .default_value = "none",
       .help = "the sampled density as an OpenVDB grid",
       .set = [](Arguments& a, const std::string& text) { a.files.field = text; }},
      {.spelling = "--report",
       .value = "FILE",
       .group = "Output",
       .range = ".json, or - for standard output",
       .default_value = "none",
       .help = "parameters, counts, metrics and times",
       .set = [](Arguments& a, const std::string& text) { a.files.report = text; }},
  };
}

std::vector<Flag> sweep_flags() {
  return {
      {.spelling = "-o,--output",
       .value = "FOLDER",
       .group = "Output",
       .range = "made where it is missing",
       .default_value = "none",
       .help = "keeps the sweep: tables, plots, pictures and what is done",
       .set = [](Arguments& a, const std::string& text) { a.folder = text; }},
      {.spelling = "--restart",
       .group = "Output",
       .default_value = "off",
       .help = "starts over and replaces the sweep in the folder",
       .set = [](Arguments& a, const std::string&) { a.restart = true; }},
      {.spelling = "--yes",
       .group = "Output",
       .default_value = "off",
       .help = "allows more than 10,000 combinations",
       .set = [](Arguments& a, const std::string&) { a.yes = true; }},
  };
}

std::vector<Flag> suggest_flags() {
  return {{.spelling = "-o,--output",
           .value = "FILE",
           .group = "Output",
           .range = ".png",
           .default_value = "TREE-suggest.png",
           .help = "the pictures, a row for each erosion",
           .set = [](Arguments& a, const std::string& text) { a.picture = text; }}};
}

std::vector<Flag> device_flags() {
  return {
      {.spelling = "--device",
       .value = "NAME",
       .group = "Device",
       .range = "part of a name, or an index",
       .default_value = "a GPU, else a CPU",
       .help = "the OpenCL device; leafhull devices lists them",
       .set = [](Arguments& a, const std::string& text) { a.device.choice = text; }},
      {.spelling = "--variant",
       .value = "NAME",
       .group = "Device",
       .range = "vector, work-item",
       .default_value = "by device type",
       .help = "the density kernel; the result is the same within rounding",
       .set =
           [](Arguments& a, const std::string& text) {
             a.device.variant = kVariants[choice("--variant", text, kVariants)];
           }},
      {.spelling = "--threads",
       .value = "N",
       .group = "Device",
       .range = "[1, 1024]",
       .default_value = "all cores",
       .help = "bounds the threads of OpenCL on the CPU and of TBB",
       .set =
           [](Arguments& a, const std::string& text) {
             a.device.threads = whole_number("--threads", text, 1, kMostThreads);
           }},
  };
}

std::vector<Flag> console_flags() {
  return {
      {.spelling = "-q,--quiet",
       .group = "General",
       .default_value = "off",
       .help = "prints errors only",
       .set = [](Arguments& a, const std::string&) { a.quiet = true; }},
      {.spelling = "-v,--verbose",
       .group = "General",
       .default_value = "off",
       .help = "prints what was found and how long each stage took",
       .set = [](Arguments& a, const std::string&) { a.verbose = true; }},
  };
}

std::vector<Flag> json_flags() {
  return {{.spelling = "--json",
           .group = "General",
           .default_value = "off",
           .help = "prints JSON instead of a table",
           .set = [](Arguments& a, const std::string&) { a.json = true; }}};
}

std::vector<Flag> help_flags() {
  return {
      {.spelling = "-h,--help",
       .group = "General",
       .help = "prints this page",
       .set = [](Arguments&, const std::string&) { throw CLI::CallForHelp(); }},
      {.spelling = "--version",
       .group = "General",
       .help = "prints the version",
       .set =
           [](Arguments&, const std::string&) {
             throw CLI::CallForVersion("leafhull " + std::string(kVersion), 0);
           }},
  };
}

std::vector<Flag> all_of(std::initializer_list<std::vector<Flag>> groups) {
  std::vector<Flag> flags;
  for (const auto& group : groups) flags.insert(flags.end(), group.begin(), group.end());
  return flags;
}

std::vector<std::string> joined_words(std::vector<std::string> command,
                                      const std::vector<Flag>& flags) {
  for (const Flag& flag : flags) {
    if (flag.word.empty()) continue;
    for (std::size_t i = 1; i < command.size(); ++i) {
      if (command[i - 1] != flag.spelling || command[i] != flag.word) continue;
      command[i - 1] = with_word(flag);
      command.erase(command.begin() + static_cast<std::ptrdiff_t>(i));
    }
  }
  return command;
}

void add_flags(CLI::App& app, const std::vector<Flag>& flags, Arguments& arguments) {
  app.set_help_flag();
  for (const Flag& flag : flags) {
    if (flag.value.empty()) {
      app.add_flag_callback(flag.spelling, [&flag, &arguments] { flag.set(arguments, {}); });
      if (flag.word.empty()) continue;
      app.add_flag_callback(with_word(flag),
                            [&flag, &arguments] { flag.set(arguments, std::string(flag.word)); });
      continue;
    }
    app.add_option_function<std::vector<std::string>>(
           flag.spelling,
           [&flag, &arguments](const std::vector<std::string>& values) {
             if (values.size() > 1 && !flag.repeatable) {
               throw Error(ErrorCode::usage, flag.spelling + " is given more than once",
                           "Give it once.");
             }
             for (const std::string& value : values) flag.set(arguments, value);
           })
        ->allow_extra_args(false);
  }
}

}  // namespace leafhull::cli
