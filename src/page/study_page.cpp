// SPDX-License-Identifier: Apache-2.0
#include "page/study_page.h"

#include <kainjow/mustache.hpp>
#include <string>
#include <string_view>

#include "leafhull/error.h"
#include "page/report_data.h"

namespace leafhull {

// Embedded at build time. The viewer is empty where leafhull is built without.
extern const std::string_view report_template, report_style, report_viewer;

namespace {

namespace mustache = kainjow::mustache;

/// Turns empty values into false, since the template language treats an empty text as true.
mustache::data to_mustache(const nlohmann::json& json) {
  if (json.is_boolean()) return json.get<bool>();
  if (json.empty()) return false;
  if (json.is_string()) {
    const auto& text = json.get_ref<const std::string&>();
    return text.empty() ? mustache::data(false) : mustache::data(text);
  }
  mustache::data data(json.is_array() ? mustache::data::type::list : mustache::data::type::object);
  for (const auto& [key, value] : json.items()) {
    if (json.is_array()) {
      data.push_back(to_mustache(value));
    } else {
      data.set(key, to_mustache(value));
    }
  }
  return data;
}

}  // namespace

void write_report(const Study& study, std::span<const TreePlots> plots, std::ostream& stream) {
  nlohmann::json data = report_data(study, plots);
  data["css"] = report_style;
  data["viewer"] = report_viewer;
  mustache::mustache page{std::string(report_template)};
  page.render(to_mustache(data), [&](const std::string& text) { stream << text; });
  if (!page.is_valid()) throw Error(ErrorCode::internal, "report.html: " + page.error_message());
}

}  // namespace leafhull
