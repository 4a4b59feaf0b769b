// SPDX-License-Identifier: Apache-2.0
#include "cli/verb.h"

namespace leafhull::cli {
namespace {

struct LeftOut {
  std::string_view verb, option;
};

/// The verbs that this build leaves out.
constexpr LeftOut kLeftOut[] = {
#ifndef LEAFHULL_HAS_STUDY
    {"suggest", "LEAFHULL_STUDY"},
    {"sweep", "LEAFHULL_STUDY"},
    {"study", "LEAFHULL_STUDY"},
#endif
#ifndef LEAFHULL_HAS_RENDER
    {"render", "LEAFHULL_RENDER"},
#endif
#ifndef LEAFHULL_HAS_FOREST
    {"forest", "LEAFHULL_FOREST"},
    {"scatter", "LEAFHULL_FOREST"},
#endif
    {}};

}  // namespace

std::vector<Verb> all_verbs() {
  return {
      extract_verb(), inspect_verb(),
#ifdef LEAFHULL_HAS_STUDY
      suggest_verb(), sweep_verb(),         study_verb(),
#endif
#ifdef LEAFHULL_HAS_RENDER
      render_verb(),  help_pictures_verb(), help_styles_verb(),
#endif
#ifdef LEAFHULL_HAS_FOREST
      forest_verb(),  scatter_verb(),       help_forests_verb(),
#endif
      devices_verb(), completion_verb(),    help_options_verb(), help_manual_verb(),
  };
}

std::string_view option_that_brings(std::string_view verb) {
  for (const LeftOut& left_out : kLeftOut) {
    if (left_out.verb == verb) return left_out.option;
  }
  return {};
}

}  // namespace leafhull::cli
