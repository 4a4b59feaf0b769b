// SPDX-License-Identifier: Apache-2.0
// Shell completion scripts, made from the verbs' flags.
#include <algorithm>
#include <iostream>
#include <map>
#include <string>
#include <vector>

#include "cli/values.h"
#include "cli/verb.h"

namespace leafhull::cli {
namespace {

constexpr std::string_view kShells[] = {"bash", "zsh", "fish"};

bool is_file(const OptionLine& line) { return line.value.ends_with("FILE"); }
bool is_folder(const OptionLine& line) { return line.value == "FOLDER" || line.value == "DIR"; }

/// The words that may follow a flag, with a space between them; empty where names do not tell.
std::string words_of(const OptionLine& line) {
  return line.word.empty() ? joined(line.choices, " ") : std::string(line.word);
}

/// "-o" and "--output" of "-o,--output".
std::vector<std::string> names_of(const OptionLine& line) {
  const std::size_t comma = line.spelling.find(',');
  if (comma == std::string::npos) return {line.spelling};
  return {line.spelling.substr(0, comma), line.spelling.substr(comma + 1)};
}

/// The lines of the flags that tables list.
std::vector<OptionLine> lines_of(const std::vector<Flag>& flags) {
  std::vector<OptionLine> lines;
  for (const Flag& flag : flags) {
    if (!flag.hidden) lines.push_back(flag.line);
  }
  return lines;
}

std::string names_of(const std::vector<OptionLine>& lines) {
  return joined(lines, " ", [](const OptionLine& line) { return names_of(line).back(); });
}

std::vector<Verb> visible_verbs() {
  std::vector<Verb> verbs = all_verbs();
  std::erase_if(verbs, [](const Verb& verb) { return verb.hidden; });
  return verbs;
}

std::string with_backslashes(std::string_view text, std::string_view special) {
  std::string escaped;
  for (const char c : text) {
    if (special.find(c) != std::string_view::npos) escaped += '\\';
    escaped += c;
  }
  return escaped;
}

/// The bash words that follow a flag: its value or a word.
std::string bash_after(const OptionLine& line) {
  if (line.value.empty()) return "next+=' " + words_of(line) + "'";
  return "next='" + words_of(line) + "' places=" +
         (is_file(line)     ? "'file'"
          : is_folder(line) ? "'directory'"
                            : "''");
}

std::string bash_case(const Verb& verb) {
  const std::vector<OptionLine> lines = lines_of(verb.flags);
  std::map<std::string, std::string> flags_of;  // by what follows them
  for (const OptionLine& line : lines) {
    if (line.value.empty() && line.word.empty()) continue;
    std::string& flags = flags_of[bash_after(line)];
    for (const std::string& name : names_of(line)) flags += (flags.empty() ? "" : " | ") + name;
  }
  std::string text = "    " + std::string(verb.name) + ")\n      next='" + names_of(lines) + "'\n";
  if (verb.takes_operand()) {
    text += verb.operand_words.empty() ? "      places='file'\n"
                                       : "      next+=' " + joined(verb.operand_words, " ") + "'\n";
  }
  text += "      case $before in\n";
  for (const auto& [after, flags] : flags_of) {
    text.append("        ").append(flags).append(") ").append(after).append(" ;;\n");
  }
  return text + "      esac\n      ;;\n";
}

std::string bash_script() {
  std::string verbs, cases;
  for (const Verb& verb : visible_verbs()) {
    verbs.append(verb.name).append(" ");
    cases += bash_case(verb);
  }
  return "# bash completion of leafhull\n"
         "_leafhull() {\n"
         "  local word=${COMP_WORDS[COMP_CWORD]} before=${COMP_WORDS[COMP_CWORD - 1]}\n"
         "  local verb=${COMP_WORDS[1]} next='' places=''\n"
         "  if [[ $word == = ]]; then\n"
         "    word=''\n"
         "  elif [[ $before == = ]]; then\n"
         "    before=${COMP_WORDS[COMP_CWORD - 2]}\n"
         "  fi\n"
         "  ((COMP_CWORD > 1)) || verb=''\n"
         "  case $verb in\n"
         "    '') next='" +
         verbs + names_of(lines_of(help_flags())) + "' ;;\n" + cases +
         "  esac\n"
         "  mapfile -t COMPREPLY < <(\n"
         "    compgen -W \"$next\" -- \"$word\"\n"
         "    [[ -z $places ]] || compgen -A \"$places\" -- \"$word\"\n"
         "  )\n"
         "  [[ -z $places ]] || compopt -o filenames 2> /dev/null || true\n"
         "}\n"
         "complete -F _leafhull leafhull\n";
}

std::string zsh_flag(const OptionLine& line) {
  const std::vector<std::string> names = names_of(line);
  std::string spec = line.repeatable ? "'*'" : "";
  if (names.size() > 1) {
    if (!line.repeatable) spec = "'(" + names[0] + " " + names[1] + ")'";
    spec += "{" + names[0] + "," + names[1] + "}";
  } else {
    spec += names[0];
  }
  std::string what = "[" + with_backslashes(line.help, "[]\\") + "]";
  const std::string words = words_of(line);
  if (!line.value.empty() || !words.empty()) {
    what += (line.value.empty() ? "::" : ":") +
            with_backslashes(line.value.empty() ? "word" : line.value, ":") + ":";
    what += is_file(line) && !words.empty() ? "{compadd " + words + "; _files}"
            : is_file(line)                 ? "_files"
            : is_folder(line)               ? "_files -/"
            : !words.empty()                ? "(" + words + ")"
                                            : " ";
  }
  return "        " + spec + cli::quoted(what) + " \\\n";
}

std::string zsh_script() {
  std::string verbs, cases;
  for (const Verb& verb : visible_verbs()) {
    const std::string name(verb.name);
    verbs += "    " + cli::quoted(name + ":" + std::string(verb.summary)) + "\n";
    cases += "    " + name + ")\n      _arguments -s \\\n";
    for (const OptionLine& line : lines_of(verb.flags)) cases += zsh_flag(line);
    const std::string operand =
        verb.operand_words.empty() ? "_files" : "(" + joined(verb.operand_words, " ") + ")";
    cases += "        " +
             (verb.takes_operand() ? cli::quoted((verb.takes_trees ? "*:" : "1:") +
                                                 std::string(verb.operand) + ":" + operand)
                                   : "") +
             "\n      ;;\n";
  }
  return "#compdef leafhull\n"
         "_leafhull() {\n"
         "  local -a verbs=(\n" +
         verbs +
         "  )\n"
         "  if ((CURRENT == 2)); then\n"
         "    _describe verb verbs\n"
         "    return\n"
         "  fi\n"
         "  shift words\n"
         "  ((CURRENT--))\n"
         "  case $words[1] in\n" +
         cases +
         "  esac\n"
         "}\n"
         "if [[ $funcstack[1] == _leafhull ]]; then\n"
         "  _leafhull \"$@\"\n"
         "else\n"
         "  compdef _leafhull leafhull\n"
         "fi\n";
}

std::string fish_flag(const std::string& condition, const OptionLine& line) {
  std::string text = "complete -c leafhull -n " + condition;
  for (const std::string& name : names_of(line)) {
    text += name.starts_with("--") ? " -l " + name.substr(2) : " -s " + name.substr(1);
  }
  const std::string words = words_of(line);
  if (!line.value.empty()) text += is_file(line) ? " -r -F" : " -x";
  if (is_folder(line)) text += " -a '(__fish_complete_directories)'";
  if (!line.value.empty() && !words.empty()) text += " -a " + cli::quoted(words);
  return text + " -d " + cli::quoted(std::string(line.help)) + "\n";
}

std::string fish_script() {
  std::string page = "# fish completion of leafhull\ncomplete -c leafhull -f\n";
  for (const OptionLine& line : lines_of(help_flags())) {
    page += fish_flag("__fish_use_subcommand", line);
  }
  for (const Verb& verb : visible_verbs()) {
    const std::string name(verb.name), condition = "'__fish_seen_subcommand_from " + name + "'";
    page += "complete -c leafhull -n __fish_use_subcommand -a " + name + " -d " +
            cli::quoted(std::string(verb.summary)) + "\n";
    if (verb.takes_operand()) {
      page += "complete -c leafhull -n " + condition +
              (verb.operand_words.empty() ? " -F"
                                          : " -a " + cli::quoted(joined(verb.operand_words, " "))) +
              "\n";
    }
    for (const OptionLine& line : lines_of(verb.flags)) page += fish_flag(condition, line);
  }
  return page;
}

void run_completion(const Arguments& arguments) {
  constexpr std::string (*kScripts[])() = {bash_script, zsh_script, fish_script};
  std::cout << kScripts[choice("SHELL", arguments.operand.string(), kShells)]();
}

}  // namespace

Verb completion_verb() {
  return {.name = "completion",
          .summary = "a completion script for bash, zsh or fish",
          .about =
              "Prints a script with which SHELL completes verbs, options and their values. It is\n"
              "installed with leafhull where the shells look for it.",
          .examples =
              "  source <(leafhull completion bash)\n"
              "  leafhull completion zsh > ~/.zfunc/_leafhull\n"
              "  leafhull completion fish > ~/.config/fish/completions/leafhull.fish\n",
          .takes_tree = true,
          .operand = "SHELL",
          .operand_help = "bash, zsh or fish",
          .operand_example = "bash",
          .operand_words = kShells,
          .flags = help_flags(),
          .run = run_completion};
}

}  // namespace leafhull::cli
