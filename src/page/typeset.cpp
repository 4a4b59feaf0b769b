// SPDX-License-Identifier: Apache-2.0
#include "page/typeset.h"

#include <kainjow/mustache.hpp>

#include "text/text.h"

namespace leafhull {

std::string typeset(std::string text) {
  constexpr std::string_view kSpelled = "lambda_R";
  for (std::size_t at = 0; (at = text.find(kSpelled, at)) != std::string::npos;) {
    text.replace(at, kSpelled.size(), "λ_R");
  }
  std::string html;
  for (const TextRun& run : split_subscripts(text)) {
    std::string plain;
    for (const char32_t character : run.text) append_utf8(character, plain);
    plain = kainjow::mustache::html_escape(plain);
    html += run.subscript ? "<sub>" + plain + "</sub>" : plain;
  }
  return html;
}

}  // namespace leafhull
