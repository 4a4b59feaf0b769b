// SPDX-License-Identifier: Apache-2.0
#include "sweep/sweep_plan.h"

#include <algorithm>
#include <map>
#include <optional>
#include <set>
#include <utility>

#include "leafhull/error.h"
#include "leafhull/version.h"
#include "output/report.h"
#include "runs/difference.h"
#include "runs/identity.h"
#include "text/choice.h"

namespace leafhull {
namespace {

/// Resolved options by name, as a report has them.
Json parameters(const Options& options) {
  Report report;
  report.options = options;
  Json parameters = report_object(report, {})["parameters"];
  const auto as_asked = [&](const char* name, const auto& value) {
    parameters[name] = value ? Json(*value) : Json();
  };
  as_asked("threshold", options.threshold);
  as_asked("resolution", options.resolution);
  as_asked("voxel_size", options.voxel_size);
  parameters.erase("radius_max_model");
  return parameters;
}

/// The values of every option, in the order in which the combinations come to them.
Json option_values(const SweepPlan& plan) {
  Json values = Json::object();
  std::map<std::string, std::set<Json>> seen;
  for (const Options& options : plan.combinations()) {
    const Json resolved = parameters(options);
    for (const auto& [name, value] : resolved.items()) {
      if (seen[name].insert(value).second) values[name].push_back(value);
    }
  }
  return values;
}

/// A list of values as a sentence names it.
std::string listed(const Json& values) {
  constexpr std::size_t kMost = 60;
  const std::string text = joined(values, ", ", [](const Json& value) {
    return value.is_null() ? "unset" : value.is_string() ? value.get<std::string>() : value.dump();
  });
  return text.size() <= kMost ? text : text.substr(0, text.rfind(',', kMost)) + ", ...";
}

std::string words_of(const Difference& differs, const Json& there, const Json& here) {
  const std::string part = differs.path.empty() ? "" : differs.path.front();
  if (part == "version") return "it was made by leafhull " + there.value("version", "?");
  if (part == "leaves") return "it has another tree or other leaves";
  if (part == "device") return "it was computed on " + there.value("device", "?");
  if (part != "options" || differs.path.size() == 1) return "it sweeps other options";
  const std::string& name = differs.path[1];
  const auto values_in = [&](const Json& sweep) {
    return listed(sweep.at("options").value(name, Json::array()));
  };
  std::string option = name;
  std::replace(option.begin(), option.end(), '_', '-');
  return "its --" + option + " is " + values_in(there) + ", not " + values_in(here);
}

/// Text for a file name, with - for spaces.
std::string file_text(std::string text) {
  std::replace(text.begin(), text.end(), ' ', '-');
  return text;
}

[[noreturn]] void refuse_option(const SweptOption& option, const std::string& why,
                                const std::string& remedy) {
  throw Error(ErrorCode::usage, "--" + std::string(option.row->name) + " " + why, remedy);
}

/// Sorts the options as in option_table(), which is one array.
std::vector<SweptOption> in_order(std::vector<SweptOption> swept) {
  std::ranges::sort(swept, {}, &SweptOption::row);
  const auto twice = std::ranges::adjacent_find(swept, {}, &SweptOption::row);
  if (twice != swept.end()) refuse_option(*twice, "is swept twice", "Give all its values at once.");
  return swept;
}

std::vector<Options> combined(const Options& options, const std::vector<SweptOption>& swept) {
  std::vector<Options> all = {options};
  for (const SweptOption& option : swept) {
    std::vector<Options> finer;
    finer.reserve(all.size() * option.values.size());
    for (const Options& coarse : all) {
      for (const std::string& value : option.values) {
        set_swept(finer.emplace_back(coarse), *option.row, value);
      }
    }
    all = std::move(finer);
  }
  for (Options& combination : all) combination = resolve(combination);
  return all;
}

}  // namespace

SweepPlan plan_sweep(const Options& options, std::vector<SweptOption> swept) {
  if (swept.empty()) {
    throw Error(ErrorCode::usage, "no option is swept", "Give one a range or a list.");
  }
  for (SweptOption& option : swept) {
    if (!can_sweep(*option.row)) refuse_option(option, "cannot be swept", "Give it one value.");
    if (option.values.empty()) refuse_option(option, "has no values", "Give it a range or a list.");
    const bool is_unread = takes_number(*option.row) && option.values.size() == 1;
    if (is_unread) option = swept_number(*option.row, option.values.front());
  }
  swept = in_order(std::move(swept));
  (void)combination_count(swept);
  std::vector<Options> combinations = combined(options, swept);
  return {std::move(swept), std::move(combinations)};
}

Json identity(const LeafSet& leaves, const SweepPlan& plan, const DeviceInfo& device) {
  Json swept = Json::array();
  for (const SweptOption& option : plan.swept()) swept.push_back(option.row->name);
  return {{"schema", kJournalSchema},
          {"version", kVersion},
          {"leaves",
           {checksum_of(leaves), leaves.leaf_count, leaves.dropped_leaves,
            leaves.crown.longest_side()}},
          {"device", text_of(device)},
          {"options", option_values(plan)},
          {"swept", swept}};
}

void check_same_sweep(const Json& there, const Json& here, const std::filesystem::path& folder) {
  const std::optional<Difference> differs = first_difference(there, here);
  if (!differs) return;
  throw Error(ErrorCode::usage,
              folder.string() + " holds another sweep: " + words_of(*differs, there, here),
              "Name another folder, or give --restart to replace that sweep.");
}

std::vector<std::string_view> values_of(const SweepPlan& plan, std::size_t combination) {
  std::vector<std::string_view> values(plan.swept().size());
  for (std::size_t i = plan.swept().size(); i-- > 0;) {
    const std::vector<std::string>& all = plan.swept()[i].values;
    values[i] = all[combination % all.size()];
    combination /= all.size();
  }
  return values;
}

std::vector<std::string> labels(const SweepPlan& plan, std::size_t combination) {
  const std::vector<std::string_view> values = values_of(plan, combination);
  std::vector<std::string> labels;
  for (std::size_t i = 0; i < values.size(); ++i) {
    labels.push_back(std::string(plan.swept()[i].row->name) + " " + std::string(values[i]));
  }
  return labels;
}

std::string picture_name(const SweepPlan& plan, std::size_t combination) {
  constexpr std::size_t kLongest = 200;  // file systems take 255
  const std::size_t width = std::to_string(plan.combinations().size()).size();
  std::string name = std::to_string(combination + 1);
  name.insert(0, width - name.size(), '0');
  for (const std::string& label : labels(plan, combination)) name += "-" + file_text(label);
  return name.substr(0, kLongest) + ".png";
}

}  // namespace leafhull
