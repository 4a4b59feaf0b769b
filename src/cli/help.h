// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <string>

#include "cli/verb.h"

namespace leafhull::cli {

std::string command_help(std::span<const Verb> verbs);
std::string verb_help(const Verb& verb);

/// The flags as Markdown tables, one per group.
std::string markdown(std::span<const Flag> flags);

}  // namespace leafhull::cli
