// SPDX-License-Identifier: Apache-2.0
#include "page/typeset.h"

#include <kainjow/mustache.hpp>
#include <regex>

namespace leafhull {

std::string typeset(const std::string& text) {
  static const std::regex radius("\\bR_max\\b"), flatness("\\blambda_R\\b");
  const std::string html = kainjow::mustache::html_escape(text);
  return std::regex_replace(std::regex_replace(html, radius, "R<sub>max</sub>"), flatness,
                            "λ<sub>R</sub>");
}

}  // namespace leafhull
