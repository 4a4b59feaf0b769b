// SPDX-License-Identifier: Apache-2.0
// The manual page, made of the verbs and their flags.
#include <iostream>
#include <map>
#include <string>
#include <utility>

#include "cli/help.h"
#include "cli/verb.h"
#include "leafhull/version.h"

namespace leafhull::cli {
namespace {

/// Text escaped so that roff reads none of it as a command.
std::string roff(std::string_view text) {
  std::string escaped;
  for (const char c : text) {
    const bool at_start = escaped.empty() || escaped.back() == '\n';
    if (at_start && (c == '.' || c == '\'')) escaped += "\\&";
    escaped += c == '\\' ? std::string("\\e") : c == '-' ? std::string("\\-") : std::string(1, c);
  }
  return escaped;
}

/// Text with its paragraphs set apart.
std::string paragraphs(std::string_view text) {
  std::string page = roff(text);
  for (std::size_t at = 0; (at = page.find("\n\n", at)) != std::string::npos;) {
    page.replace(at, 2, "\n.PP\n");
  }
  return page + "\n";
}

std::string entry_of(const OptionLine& line) {
  const std::string details = facts(line);
  return ".TP\n.B " + roff(spelled(line)) + "\n" + roff(line.help) +
         (details.empty() ? "" : " (" + roff(details) + ")") + "\n";
}

/// Which verb has already listed a group of options; later verbs refer to it.
using Told = std::map<std::string, std::string_view>;

std::string section(const Verb& verb, Told& told) {
  std::string page = ".SS " + std::string(verb.name) + "\n" + paragraphs(verb.about) +
                     ".PP\n.B leafhull " + std::string(verb.name) +
                     (verb.takes_operand() ? " " + std::string(verb.operand) : "") + " [options]\n";
  std::vector<std::pair<std::string_view, std::string>> groups;
  for (const Flag& flag : verb.flags) {
    if (flag.hidden) continue;
    if (groups.empty() || groups.back().first != flag.line.group) {
      groups.push_back({flag.line.group, ""});
    }
    groups.back().second += entry_of(flag.line);
  }
  std::map<std::string_view, std::string> of_others;
  for (const auto& [group, entries] : groups) {
    const auto [first, is_new] = told.emplace(entries, verb.name);
    if (is_new) {
      page += ".PP\n.I " + std::string(group) + "\n" + entries;
    } else {
      std::string& also = of_others[first->second];
      also += (also.empty() ? "" : ", ") + std::string(group);
    }
  }
  for (const auto& [other, also] : of_others) {
    page += ".PP\nAnd the options of " + std::string(other) + " under " + also + ".\n";
  }
  return page + ".PP\n.nf\n" + roff(verb.examples) + ".fi\n";
}

void print_manual(const Arguments&) {
  std::string page = ".TH LEAFHULL 1 \"\" \"leafhull " + std::string(kVersion) +
                     "\"\n.SH NAME\nleafhull \\- the abstract shape of a tree, from its leaves\n"
                     ".SH SYNOPSIS\n.B leafhull\n.I VERB\n[options]\n.SH DESCRIPTION\n" +
                     paragraphs(command_about()) + ".SH VERBS\n";
  Told told;
  for (const Verb& verb : all_verbs()) {
    if (!verb.hidden) page += section(verb, told);
  }
  std::cout << page << ".SH EXIT STATUS\n" << paragraphs(exit_codes());
}

}  // namespace

Verb help_manual_verb() {
  return {.name = "help-manual",
          .summary = "Prints the manual page in roff.",
          .about = "Prints the manual page in roff.",
          .examples = "  leafhull help-manual > leafhull.1\n",
          .hidden = true,
          .flags = help_flags(),
          .run = print_manual};
}

}  // namespace leafhull::cli
