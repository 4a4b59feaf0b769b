// SPDX-License-Identifier: Apache-2.0
#include <CLI/CLI.hpp>
#include <algorithm>
#include <exception>
#include <iostream>
#include <vector>

#include "cli/console.h"
#include "cli/help.h"
#include "cli/values.h"
#include "cli/verb.h"
#include "leafhull/error.h"

namespace leafhull::cli {
namespace {

std::string with_guess(std::string_view word, std::span<const std::string_view> valid,
                       const std::string& otherwise) {
  const std::string_view near = nearest(word, valid);
  return near.empty() ? otherwise : "Did you mean " + std::string(near) + "? " + otherwise;
}

[[noreturn]] void refuse_option(const std::string& word, const std::vector<Flag>& flags,
                                const std::string& remedy) {
  std::vector<std::string_view> spellings;
  for (const Flag& flag : flags) {
    spellings.push_back(std::string_view(flag.line.spelling).substr(flag.line.spelling.find("--")));
  }
  const std::string option = word.substr(0, word.find('='));
  throw Error(ErrorCode::usage, "the option " + option + " is unknown",
              with_guess(option, spellings, remedy));
}

bool is_option(const std::string& word) { return word.starts_with('-'); }

/// Refuses words that neither the verb nor its flags took.
void refuse_extras(std::vector<std::string> extras, const Verb& verb) {
  std::erase(extras, "--");
  if (extras.empty()) return;
  const std::string help = "See leafhull " + std::string(verb.name) + " --help.";
  const auto option = std::find_if(extras.begin(), extras.end(), is_option);
  if (option != extras.end()) refuse_option(*option, verb.flags, help);
  throw Error(ErrorCode::usage, "'" + extras.front() + "' is one word too many",
              verb.takes_tree ? "Give one " + std::string(verb.operand) + ". " + help : help);
}

[[noreturn]] void refuse_verb(const std::vector<std::string>& words, std::span<const Verb> verbs) {
  std::vector<std::string_view> valid;
  for (const Verb& verb : verbs) {
    if (!verb.hidden) valid.push_back(verb.name);
  }
  const std::string remedy = "Choose from: " + joined(valid, ", ") + ". See leafhull --help.";
  if (words.empty()) throw Error(ErrorCode::usage, "no verb is given", remedy);
  if (is_option(words.front())) refuse_option(words.front(), help_flags(), remedy);
  if (const std::string_view option = option_that_brings(words.front()); !option.empty()) {
    throw Error(ErrorCode::usage, "this leafhull was built without " + words.front(),
                "Configure it with -D" + std::string(option) + "=ON and build it again.");
  }
  throw Error(ErrorCode::usage, "the verb '" + words.front() + "' is unknown",
              with_guess(words.front(), valid, remedy));
}

CLI::App* add_verb(CLI::App& app, const Verb& verb, Arguments& arguments) {
  CLI::App* sub = app.add_subcommand(std::string(verb.name), std::string(verb.summary));
  sub->allow_extras();
  add_flags(*sub, verb.flags, arguments);
  if (verb.takes_tree) sub->add_option("TREE", arguments.operand);
  if (verb.takes_trees) sub->add_option("TREE", arguments.trees);
  sub->formatter_fn([&verb](auto&&...) { return verb_help(verb); });
  return sub;
}

void run(const std::vector<std::string>& command) {
  const std::vector<Verb> verbs = all_verbs();
  const std::vector<Flag> flags = help_flags();
  Arguments arguments;
  arguments.command = command;
  CLI::App app;
  app.allow_extras();
  add_flags(app, flags, arguments);
  app.formatter_fn([&verbs](auto&&...) { return command_help(verbs); });
  for (const Verb& verb : verbs) add_verb(app, verb, arguments);

  try {
    std::vector<std::string> words = command;
    for (const Verb& verb : verbs) words = joined_words(std::move(words), verb.flags);
    app.parse(std::vector<std::string>(words.rbegin(), words.rend() - 1));
  } catch (const CLI::CallForHelp&) {
    std::cout << app.help();
    return;
  } catch (const CLI::CallForVersion& version) {
    std::cout << version.what() << '\n';
    return;
  } catch (const CLI::ArgumentMismatch& error) {
    const std::string_view what = error.what();
    throw Error(ErrorCode::usage, std::string(what.substr(0, what.find(':'))) + " needs a value",
                "See leafhull --help.");
  } catch (const CLI::ParseError& error) {
    throw Error(ErrorCode::usage, error.what(), "See leafhull --help.");
  }

  const auto is_chosen = [&](const Verb& verb) {
    return app.got_subcommand(std::string(verb.name));
  };
  const auto verb = std::find_if(verbs.begin(), verbs.end(), is_chosen);
  if (verb == verbs.end()) refuse_verb(app.remaining(), verbs);
  if (!app.remaining().empty()) {
    throw Error(ErrorCode::usage, app.remaining().front() + " comes before the verb",
                "Options follow the verb: leafhull " + std::string(verb->name) + " [options].");
  }
  refuse_extras(app.get_subcommand(std::string(verb->name))->remaining(), *verb);
  if ((verb->takes_tree && arguments.operand.empty()) ||
      (verb->takes_trees && arguments.trees.empty())) {
    const std::string_view operand = verb->operand.substr(0, verb->operand.find("..."));
    throw Error(ErrorCode::usage, "no " + std::string(operand) + " is given",
                "Give " + std::string(verb->operand_help) + ": leafhull " +
                    std::string(verb->name) + " " + std::string(verb->operand_example) + ".");
  }
  const ThreadLimit limit(arguments.device.threads);
  verb->run(arguments);
}

int exit_code(const std::vector<std::string>& command) {
  try {
    run(command);
    if (!std::cout.flush()) {
      throw Error(ErrorCode::output, "standard output could not be written",
                  "Check the disk or the pipe that it goes to.");
    }
    return 0;
  } catch (const std::exception&) {
    std::cout.flush();
    const Failure failure = current_failure();
    print_error(failure.what, failure.remedy);
    return failure.exit_code;
  }
}

}  // namespace
}  // namespace leafhull::cli

int main(int argc, char** argv) { return leafhull::cli::exit_code({argv, argv + argc}); }
