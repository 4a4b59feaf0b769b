// SPDX-License-Identifier: Apache-2.0
#include "cli/help.h"

#include <algorithm>
#include <iostream>
#include <string_view>
#include <utility>
#include <vector>

#include "cli/values.h"
#include "leafhull/options.h"

namespace leafhull::cli {
namespace {

constexpr std::size_t kIndent = 28;
constexpr std::size_t kWidth = 98;

std::string padded(std::string text, std::size_t width) {
  text.resize(std::max(text.size(), width), ' ');
  return text;
}

/// `text` broken at spaces into lines of at most kWidth - kIndent.
std::vector<std::string> wrapped(std::string_view text) {
  constexpr std::size_t kRoom = kWidth - kIndent;
  std::vector<std::string> lines;
  while (text.size() > kRoom) {
    const std::size_t space = text.rfind(' ', kRoom);
    if (space == std::string_view::npos) break;
    lines.emplace_back(text.substr(0, space));
    text.remove_prefix(space + 1);
  }
  lines.emplace_back(text);
  return lines;
}

/// A term with its lines of text beside it.
std::string entry(std::string_view term, const std::vector<std::string>& lines) {
  std::string page = "  " + std::string(term);
  const bool beside = page.size() + 2 <= kIndent;
  page = beside ? padded(page, kIndent) : page + "\n" + std::string(kIndent, ' ');
  for (std::size_t i = 0; i < lines.size(); ++i) {
    page += (i > 0 ? std::string(kIndent, ' ') : "") + lines[i] + "\n";
  }
  return page;
}

std::string entry(std::string_view term, std::string_view text) {
  return entry(term, wrapped(text));
}

/// The meaning with unit, range and default, which go on their own line where they do not fit.
std::string help_line(const OptionLine& line) {
  const std::string details = facts(line);
  if (details.empty()) return entry(spelled(line), line.help);
  const std::string whole = std::string(line.help) + " (" + details + ")";
  if (wrapped(whole).size() == 1) return entry(spelled(line), whole);
  std::vector<std::string> lines = wrapped(line.help);
  for (std::string& more : wrapped("(" + details + ")")) lines.push_back(std::move(more));
  return entry(spelled(line), lines);
}

std::string markdown_row(const OptionLine& line) {
  const auto cell = [](std::string_view text) {
    std::string escaped(" ");
    for (const char c : text) escaped += c == '|' ? std::string("\\|") : std::string(1, c);
    return escaped + " |";
  };
  return "|" + cell("`" + spelled(line) + "`") + cell(line.help) + cell(line.unit) +
         cell(line.range) + cell(line.default_value) + "\n";
}

std::string style_line(Style style) {
  Options values;
  values.style = style;
  values = resolve(values);
  std::string text = std::string(name(*values.method)) + ", R_max " + number(*values.radius_max);
  if (values.threshold) text += ", T " + number(*values.threshold);
  if (values.coverage) text += ", coverage " + number(*values.coverage);
  if (values.method != Method::isotropic) text += ", flatness " + number(*values.flatness);
  if (*values.points == PointSource::vertices) text += ", points vertices";
  if (*values.min_component > 0) text += ", min-component " + number(*values.min_component);
  return entry(name(style), text);
}

std::string styles_and_presets() {
  std::string text = "\nStyles\n";
  for (std::size_t i = 0; i < names(Style{}).size(); ++i) text += style_line(static_cast<Style>(i));
  text += "\nPresets (voxels along the longest side)\n";
  std::string presets;
  for (std::size_t i = 0; i < names(Preset{}).size(); ++i) {
    const auto preset = static_cast<Preset>(i);
    presets += (presets.empty() ? "" : ", ") + std::string(name(preset)) + " " +
               std::to_string(resolution_of(preset));
  }
  return text + "  " + presets + "\n";
}

}  // namespace

std::string spelled(const OptionLine& line) {
  std::string text = line.spelling;
  if (const std::size_t comma = text.find(','); comma != std::string::npos) {
    text.insert(comma + 1, " ");
  }
  return line.value.empty() ? text : text + " " + line.value;
}

std::string facts(const OptionLine& line) {
  const std::string by_default = line.default_value.empty() ? "" : "default " + line.default_value;
  const std::string_view all[] = {line.unit, line.range, by_default};
  return joined(all, "; ");
}

std::string_view command_about() {
  return "leafhull turns the leaves of a tree model into its abstract shape: the closed surface\n"
         "a painter would block in before drawing a single leaf.";
}

std::string_view exit_codes() {
  return "0 done, 1 internal error, 2 usage, 3 input, 4 device, 5 output, 6 the shape is empty";
}

std::string command_help(std::span<const Verb> verbs) {
  std::string page(command_about());
  page += "\n\nUsage\n  leafhull VERB [options]\n\nVerbs\n";
  for (const Verb& verb : verbs) {
    if (!verb.hidden) page += entry(verb.name, verb.summary);
  }
  page += "\nGeneral\n";
  for (const Flag& flag : help_flags()) page += help_line(flag.line);
  return page +
         "\nFirst steps\n"
         "  leafhull inspect tree.glb                 what is in the file, and what to type next\n"
         "  leafhull extract tree.glb -o shape.glb    the shape, to open in Blender\n"
         "  leafhull extract --help                   every option, with unit, range and default\n"
         "\nExit codes\n  " +
         std::string(exit_codes()) + "\n";
}

std::string verb_help(const Verb& verb) {
  std::string page(verb.about);
  page.append("\n\nUsage\n  leafhull ").append(verb.name);
  if (verb.takes_operand()) page.append(" ").append(verb.operand);
  page += " [options]\n";
  if (verb.takes_operand()) page += "\n" + entry(verb.operand, verb.operand_help);
  std::string_view group;
  for (const Flag& flag : verb.flags) {
    if (flag.hidden) continue;
    if (flag.line.group != group) page += "\n" + std::string(group = flag.line.group) + "\n";
    page += help_line(flag.line);
  }
  if (verb.name == "extract") page += styles_and_presets();
  return page + "\nExamples\n" + std::string(verb.examples);
}

std::string markdown(std::span<const Flag> flags) {
  std::string page;
  std::string_view group;
  for (const Flag& flag : flags) {
    if (flag.hidden) continue;
    if (flag.line.group != group) {
      group = flag.line.group;
      page += (page.empty() ? "" : "\n") + ("**" + std::string(group) + "**\n\n") +
              "| Option | Meaning | Unit | Range | Default |\n|---|---|---|---|---|\n";
    }
    page += markdown_row(flag.line);
  }
  return page;
}

Verb table_verb(std::string_view name, std::string_view about, std::string_view examples,
                void (*run)(const Arguments&)) {
  return {.name = name,
          .summary = about,
          .about = about,
          .examples = examples,
          .hidden = true,
          .flags = help_flags(),
          .run = run};
}

Verb help_options_verb() {
  return table_verb("help-options", "Prints the options of extract as Markdown tables.",
                    "  leafhull help-options\n",
                    [](const Arguments&) { std::cout << markdown(extract_verb().flags); });
}

}  // namespace leafhull::cli
