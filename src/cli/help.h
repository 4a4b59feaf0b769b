// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <string>
#include <string_view>

#include "cli/verb.h"

namespace leafhull::cli {

/// "-o, --output FILE"
std::string spelled(const OptionLine& line);
/// Unit, range and default, where there are any.
std::string facts(const OptionLine& line);

std::string_view command_about();  ///< what leafhull is for
std::string_view exit_codes();
std::string command_help(std::span<const Verb> verbs);
std::string verb_help(const Verb& verb);

/// The flags as Markdown tables, one per group.
std::string markdown(std::span<const Flag> flags);

/// A hidden verb that prints tables for the documentation.
Verb table_verb(std::string_view name, std::string_view about, std::string_view examples,
                void (*run)(const Arguments&));

}  // namespace leafhull::cli
