// SPDX-License-Identifier: Apache-2.0
#include "cli/verb.h"

namespace leafhull::cli {

std::vector<Verb> all_verbs() {
  return {extract_verb(),       inspect_verb(),     suggest_verb(),      sweep_verb(),
          study_verb(),         render_verb(),      forest_verb(),       scatter_verb(),
          devices_verb(),       completion_verb(),  help_options_verb(), help_forests_verb(),
          help_pictures_verb(), help_styles_verb(), help_manual_verb()};
}

}  // namespace leafhull::cli
