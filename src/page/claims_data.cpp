// SPDX-License-Identifier: Apache-2.0
#include "page/claims_data.h"

#include <algorithm>
#include <string>
#include <string_view>

#include "page/figures.h"
#include "page/typeset.h"

namespace leafhull {
namespace {

using Json = nlohmann::json;

std::string_view words(Outcome outcome) {
  switch (outcome) {
    case Outcome::holds:
      return "holds";
    case Outcome::fails:
      return "does not hold";
    case Outcome::open:
      return "cannot be told";
  }
  return "";
}

std::string tally(const ReadingStudy& reading) {
  const auto holds = std::ranges::count(reading.verdicts, Outcome::holds, &Verdict::outcome);
  return std::to_string(holds) + " of " + std::to_string(reading.verdicts.size()) + " hold";
}

Json verdict_data(const Verdict& verdict) {
  Json data = mark(verdict.outcome);
  data["number"] = verdict.number;
  data["claim"] = typeset(verdict.claim);
  data["test"] = typeset(verdict.test);
  data["figures"] = typeset(verdict.figures);
  data["paper"] = typeset(verdict.paper);
  return data;
}

Json cell(const TreeStudy& tree, std::size_t claim) {
  Json data = mark(tree.readings.front().verdicts.at(claim).outcome);
  const auto holds = std::ranges::count_if(tree.readings, [&](const ReadingStudy& reading) {
    return reading.verdicts.at(claim).outcome == Outcome::holds;
  });
  data["tree"] = tree.name;
  data["held"] = std::to_string(holds);
  data["of"] = std::to_string(tree.readings.size());
  return data;
}

}  // namespace

nlohmann::json mark(Outcome outcome) {
  return {{"outcome", name(outcome)}, {"word", words(outcome)}};
}

nlohmann::json claims_data(const Study& study) {
  Json claims = Json::array();
  const std::vector<Verdict>& first = study.trees.front().readings.front().verdicts;
  for (std::size_t i = 0; i < first.size(); ++i) {
    Json cells = Json::array();
    for (const TreeStudy& tree : study.trees) cells.push_back(cell(tree, i));
    claims.push_back({{"number", first[i].number},
                      {"claim", typeset(first[i].claim)},
                      {"cells", std::move(cells)}});
  }
  return claims;
}

nlohmann::json readings_data(const TreeStudy& tree) {
  Json readings = Json::array();
  for (const ReadingStudy& reading : tree.readings) {
    Json verdicts = Json::array();
    for (const Verdict& verdict : reading.verdicts) verdicts.push_back(verdict_data(verdict));
    readings.push_back({{"reading", reading_name(reading.reading)},
                        {"own", readings.empty()},
                        {"tally", tally(reading)},
                        {"verdicts", std::move(verdicts)}});
  }
  return readings;
}

}  // namespace leafhull
