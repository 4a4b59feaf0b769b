// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <cstdlib>
#include <nlohmann/json.hpp>
#include <regex>

#include "chart/chart.h"
#include "leafhull/error.h"
#include "page/base64.h"
#include "page/sample_study.h"
#include "page/typeset.h"
#include "unit/output_sample.h"

namespace leafhull::test {
namespace {

using nlohmann::json;
using ::testing::IsSubstring;

std::string page_of(const Study& study) {
  const TemporaryFolder folder;
  write_study(study, OutputFolder(folder.path()));
  return read_file(folder / "report.html");
}

bool holds(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

/// Removes every part of the text from `begin` to `end`.
std::string without(std::string text, const std::string& begin, const std::string& end) {
  for (std::size_t from = 0; (from = text.find(begin, from)) != std::string::npos;) {
    text.erase(from, text.find(end, from + begin.size()) + end.size() - from);
  }
  return text;
}

/// The text that a reader sees, with white space as single spaces.
std::string text_of(std::string page) {
  page = without(std::move(page), "<script", "</script>");
  page = without(std::move(page), "<style", "</style>");
  page = std::regex_replace(page, std::regex("</t[dh]>"), " ");
  page = without(std::move(page), "<", ">");
  return std::regex_replace(page, std::regex("\\s+"), " ");
}

/// Hides all programs while it lives.
class NoPrograms {
 public:
  NoPrograms() { ::setenv("PATH", "/nonexistent", 1); }
  ~NoPrograms() { ::setenv("PATH", path_.c_str(), 1); }
  NoPrograms(const NoPrograms&) = delete;

 private:
  std::string path_ = std::getenv("PATH");
};

TEST(Page, ShowsTheTablesBesideThePapers) {
  const std::string text = text_of(page_of(sample_study()));
  EXPECT_PRED_FORMAT2(IsSubstring, "birch 4,000 no surface 3,000", text);
  EXPECT_PRED_FORMAT2(IsSubstring, "the paper 13,368 2,649 10,275", text);
  EXPECT_PRED_FORMAT2(IsSubstring, "birch, L&amp;D = 1 1.00 no surface 0.75", text);
  EXPECT_PRED_FORMAT2(IsSubstring, "the paper, L&amp;D = 1 1.00 0.20 0.77", text);
  EXPECT_PRED_FORMAT2(IsSubstring, "birch, of its leaf vertices 5.0% no surface 12%", text);
  EXPECT_PRED_FORMAT2(IsSubstring, "the paper, of its leaf vertices 0.3% 47% 18%", text);
  EXPECT_PRED_FORMAT2(IsSubstring, "32³ 0.500 0.750 +50% 1.297 2.029 +56%", text);
  EXPECT_PRED_FORMAT2(IsSubstring, "64³ – – – 5.164 7.676 +49%", text);
  EXPECT_PRED_FORMAT2(IsSubstring, "500 leaves, 2,000 leaf vertices; the paper’s tree had 52,648",
                      text);
}

TEST(Page, TellsWhereTheBandLies) {
  const std::string text = text_of(page_of(sample_study()));
  EXPECT_PRED_FORMAT2(
      IsSubstring, "the mean of Niso, is 0.53. With T&nbsp;=&nbsp;4.47 L&amp;D loses 0.30%", text);
  EXPECT_PRED_FORMAT2(IsSubstring, "leaves of 2.5 times their size UNCTRLED loses 47.00%", text);
  EXPECT_PRED_FORMAT2(IsSubstring,
                      "L&amp;D 0.3% 1.00 80–100% 0.4% 0.97 does not hold 0–20% 25.0% 0.50 holds "
                      "UNCTRLED 47.0% 0.25",
                      text);
  EXPECT_PRED_FORMAT2(IsSubstring, "0 to 2 s 0.5% 0.95 does not hold", text);
  EXPECT_PRED_FORMAT2(IsSubstring, "L&amp;D 0.3% 1.00 CTRLED 18.2% 0.77 holds UNCTRLED 47.0% 0.20",
                      text);
}

TEST(Page, TellsWhyTheBandCouldNotBeMoved) {
  Study study = sample_study();
  for (TreeStudy& tree : study.trees) {
    tree.band = {};
    tree.band.evenness = 0.1;
    tree.band.failure = "L&D loses nothing";
  }
  const std::string text = text_of(page_of(study));
  EXPECT_PRED_FORMAT2(IsSubstring, "is 0.10. The band could not be moved", text);
  EXPECT_PRED_FORMAT2(IsSubstring, "could not be fitted: L&amp;D loses nothing.", text);
  EXPECT_FALSE(holds(text, "Band by"));
}

TEST(Page, TellsEveryOutcomeInWords) {
  const std::string text = text_of(page_of(sample_study()));
  EXPECT_PRED_FORMAT2(IsSubstring,
                      "1 L&amp;D swells more than CTRLED. holds holds in 2 of 2 readings", text);
  EXPECT_PRED_FORMAT2(IsSubstring, "2 Raising Rmax swells. does not hold holds in 1 of 2 readings",
                      text);
  EXPECT_PRED_FORMAT2(IsSubstring, "3 Control takes time. cannot be told holds in 0 of 2 readings",
                      text);
  EXPECT_PRED_FORMAT2(
      IsSubstring, "k = 2, standard deviation, exact density (leafhull’s own) 1 of 3 hold", text);
  EXPECT_PRED_FORMAT2(IsSubstring, "k = 1, variance, grid density 2 of 3 hold", text);
}

TEST(Page, TellsWhereItComesFrom) {
  const std::string text = text_of(page_of(sample_study()));
  EXPECT_PRED_FORMAT2(IsSubstring, "leafhull study &apos;a tree.glb&apos; -o &lt;it&gt;", text);
  for (const char* fact : {"2026-11-22", "a machine", "a device", "leafhull 1.2.3", "2.0 min"}) {
    EXPECT_PRED_FORMAT2(IsSubstring, fact, text);
  }
}

TEST(Page, EscapesNames) {
  const std::string page = page_of(sample_study());
  EXPECT_FALSE(holds(page, "<script>alert"));
  EXPECT_PRED_FORMAT2(IsSubstring,
                      "&lt;script&gt;alert(&quot;1&quot;)&lt;/script&gt; &amp; &apos;ash&apos;",
                      text_of(page));
}

TEST(Page, LeavesNoTagOfTheTemplate) {
  EXPECT_FALSE(holds(without(page_of(sample_study()), "<script", "</script>"), "{{"));
}

TEST(Page, HoldsAMeshForEverySurface) {
  const std::string page = page_of(sample_study());
  const std::regex mesh("<script type=\"application/json\">(\\{[^<]*\\})</script>");
  std::vector<json> meshes;
  for (std::sregex_iterator i(page.begin(), page.end(), mesh), end; i != end; ++i) {
    meshes.push_back(json::parse((*i)[1].str()));
  }
  ASSERT_EQ(meshes.size(), 4u);  // two for each of two trees; UNCTRLED is empty
  EXPECT_EQ(meshes[0]["triangles"], sphere(12).triangles.size());
  EXPECT_EQ(meshes[1]["vertices"], sphere(8).positions.size());
}

TEST(Page, IsTheSameForTheSameStudy) {
  EXPECT_EQ(page_of(sample_study()), page_of(sample_study()));
}

TEST(Page, DoesWithoutPicturesAndMeshes) {
  Study study = sample_study();
  study.trees.resize(1);
  TreeStudy& tree = study.trees.front();
  tree.methods.clear();
  tree.figure12.clear();
  tree.figure14.clear();
  tree.meshes = {};
  tree.bounds = {};
  const std::string page = page_of(study);
  EXPECT_FALSE(holds(page, "image/jpeg"));
  EXPECT_FALSE(holds(text_of(page), "These are still pictures"));
  EXPECT_PRED_FORMAT2(IsSubstring, "birch 4,000 no surface 3,000", text_of(page));
}

TEST(Page, SaysThatPlotsNeedGnuplot) {
  const NoPrograms nothing;
  ASSERT_FALSE(can_draw_charts());
  const TemporaryFolder folder;
  write_study(sample_study(), OutputFolder(folder.path()));
  EXPECT_EQ(folder.names(), (std::set<std::string>{"report.html", "study.json"}));
  const std::string page = read_file(folder / "report.html");
  EXPECT_FALSE(holds(page, "image/svg+xml"));
  EXPECT_PRED_FORMAT2(IsSubstring, "No curve: gnuplot was not found", text_of(page));
  EXPECT_PRED_FORMAT2(IsSubstring, "2.25 2,400 300", text_of(page));
  EXPECT_PRED_FORMAT2(IsSubstring, "80–100% 0.4% 0.97", text_of(page));
}

TEST(Page, HoldsAPlotOfEveryFigureAndOfAllReadingsAndOfTheBand) {
  if (!can_draw_charts()) GTEST_SKIP() << "gnuplot is missing";
  const TemporaryFolder folder;
  write_study(sample_study(), OutputFolder(folder.path()));
  EXPECT_EQ(folder.names(), (std::set<std::string>{"report.html", "study.json"}));
  const std::string page = read_file(folder / "report.html");
  const std::regex plot("<img src=\"data:image/svg\\+xml;base64,");
  const std::sregex_iterator first(page.begin(), page.end(), plot), end;
  EXPECT_EQ(std::distance(first, end), 2 * (3 * 2 + 1));
}

TEST(WriteStudy, MakesTheFolder) {
  const TemporaryFolder folder;
  write_study(sample_study(), OutputFolder(folder / "new"));
  EXPECT_TRUE(std::filesystem::exists(folder / "new/report.html"));
}

TEST(WriteStudy, RefusesAStudyOfNothing) {
  const TemporaryFolder folder;
  const auto refusal = [&](const Study& study) -> std::string {
    try {
      write_study(study, OutputFolder(folder / "new"));
    } catch (const Error& error) {
      EXPECT_EQ(error.code(), ErrorCode::usage);
      return error.what();
    }
    return "";
  };
  EXPECT_EQ(refusal({}), "the study has no tree");
  Study study = sample_study();
  study.trees.back().name = "birch";
  study.trees.back().readings.clear();
  EXPECT_EQ(refusal(study), "the study of birch has no readings");
  EXPECT_EQ(folder.names(), std::set<std::string>{});
}

TEST(WriteStudy, WritesAllOrNothing) {
  const TemporaryFolder folder;
  std::filesystem::create_directory(folder / "study.json");
  try {
    write_study(sample_study(), OutputFolder(folder.path()));
    FAIL() << "a folder was taken for a file";
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ErrorCode::output);
    EXPECT_PRED_FORMAT2(IsSubstring, "study.json", error.what());
  }
  EXPECT_EQ(folder.names(), std::set<std::string>{"study.json"});
}

TEST(StudyJson, HoldsTheNumbers) {
  const TemporaryFolder folder;
  write_study(sample_study(), OutputFolder(folder.path()));
  const json study = json::parse(read_file(folder / "study.json"));
  EXPECT_EQ(study["schema"], "leafhull-study/1");
  EXPECT_EQ(study["command"], "leafhull study 'a tree.glb' -o <it>");
  ASSERT_EQ(study["trees"].size(), 2u);
  EXPECT_EQ(study["trees"][1]["name"], kMarkup);
  const json& tree = study["trees"][0];
  EXPECT_EQ(tree["leaf_vertices"], 2000);
  EXPECT_EQ(tree["bounds"], json({{-2, -2, -2}, {2, 2, 2}}));
  const json& reading = tree["readings"][1];
  const json& band = tree["band"];
  EXPECT_EQ(band["falloff"], 1);
  EXPECT_EQ(band["evenness"], 0.527);
  EXPECT_EQ(band["leaf_scale"], 2.5);
  EXPECT_EQ(band["failure"], nullptr);
  EXPECT_EQ(band["ends"][1]["method"], "uncontrolled");
  EXPECT_EQ(band["by_share"][0]["band_low"], 80);
  EXPECT_EQ(band["by_share"][1]["off_site_sampled"], 500);
  EXPECT_EQ(band["by_share"][1]["claim_2b"], "holds");
  EXPECT_EQ(band["by_deviation"][0]["band_high"], 2);
  EXPECT_EQ(band["by_deviation"][0]["claim_2b"], "fails");
  EXPECT_EQ(reading["falloff"], 1);
  EXPECT_EQ(reading["spread"], "variance");
  EXPECT_EQ(reading["density"], "grid");
  EXPECT_EQ(reading["table1"][0]["dilated_voxels"], 4000);
  EXPECT_EQ(reading["table1"][1]["empty"], true);
  EXPECT_EQ(reading["figure11"][1]["threshold"], 2.25);
  EXPECT_EQ(reading["figure15"][1]["off_site_sampled"], 300);
  EXPECT_EQ(reading["table2"][0]["proposed"], 0.75);
  EXPECT_EQ(reading["table2"][1]["proposed"], nullptr);
  EXPECT_EQ(reading["verdicts"][2]["outcome"], "open");
  EXPECT_EQ(reading["verdicts"][0]["figures"], "4,000 > 3,000");
}

TEST(StudyJson, HoldsNamesThatAreNoUtf8) {
  Study study = sample_study();
  study.trees.front().name = "\xff";
  const TemporaryFolder folder;
  write_study(study, OutputFolder(folder.path()));
  EXPECT_EQ(json::parse(read_file(folder / "study.json"))["trees"][0]["name"], "\xef\xbf\xbd");
}

TEST(Base64, IsThatOfRfc4648) {
  const auto of = [](const std::string& text) {
    return base64({reinterpret_cast<const std::uint8_t*>(text.data()), text.size()});
  };
  EXPECT_EQ(of(""), "");
  EXPECT_EQ(of("f"), "Zg==");
  EXPECT_EQ(of("fo"), "Zm8=");
  EXPECT_EQ(of("foobar"), "Zm9vYmFy");
  EXPECT_EQ(of("\xff\xef\xbe"), "/+++");
}

TEST(Typeset, SetsSymbolsAndEscapes) {
  EXPECT_EQ(typeset("R_max < lambda_R"), "R<sub>max</sub> &lt; λ<sub>R</sub>");
  EXPECT_EQ(typeset("birch_2 & λ_R"), "birch_2 &amp; λ<sub>R</sub>");
}

}  // namespace
}  // namespace leafhull::test
