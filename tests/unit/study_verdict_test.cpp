// SPDX-License-Identifier: Apache-2.0
// The paper's claims, on hand-made figures.
#include <gtest/gtest.h>

#include <algorithm>
#include <stdexcept>

#include "leafhull/study.h"

namespace leafhull {
namespace {

using Numbers = std::vector<std::uint64_t>;

StudyRow row(std::uint64_t dilated, std::uint64_t off_site, bool empty = false) {
  StudyRow row;
  row.empty = empty;
  row.metrics.dilated_voxels = dilated;
  row.metrics.off_site_sampled = off_site;
  return row;
}

/// The dilated voxels and off-site vertices of L&D, UNCTRLED and CTRLED.
ReadingStudy table1(const Numbers& dilated, const Numbers& off_site) {
  ReadingStudy study;
  for (std::size_t i = 0; i < study.table1.size(); ++i) {
    study.table1[i] = row(dilated[i], off_site[i]);
    study.table1[i].method = static_cast<Method>(i);
  }
  return study;
}

std::vector<StudyRow> series(double StudyRow::*parameter, double first, double step,
                             const Numbers& dilated, const Numbers& off_site) {
  std::vector<StudyRow> rows;
  for (std::size_t i = 0; i < dilated.size(); ++i) {
    rows.push_back(row(dilated[i], off_site[i]));
    rows.back().*parameter = first + step * static_cast<double>(i);
  }
  return rows;
}

ReadingStudy figure11(const Numbers& dilated, const Numbers& off_site) {
  ReadingStudy study;
  study.figure11 = series(&StudyRow::threshold, 1.5, 0.5, dilated, off_site);
  return study;
}

ReadingStudy figure13(const Numbers& dilated, const Numbers& off_site) {
  ReadingStudy study;
  study.figure13 = series(&StudyRow::radius_max, 1.4, 0.1, dilated, off_site);
  return study;
}

/// Both figures with these off-site vertices and the same dilated voxels in all rows.
ReadingStudy figures11_and_13(const Numbers& by_threshold, const Numbers& by_radius) {
  ReadingStudy study = figure13(Numbers(by_radius.size(), 1), by_radius);
  study.figure11 = figure11(Numbers(by_threshold.size(), 1), by_threshold).figure11;
  return study;
}

/// Figure 15 from the lowest lambda_R to the highest.
ReadingStudy figure15(const Numbers& dilated, const Numbers& off_site) {
  ReadingStudy study;
  study.figure15 = series(&StudyRow::flatness, 0.6, 0.1, dilated, off_site);
  return study;
}

ReadingStudy table2(const std::vector<StudyTime>& times) {
  ReadingStudy study;
  study.table2 = times;
  return study;
}

void lose_every_surface(ReadingStudy& study) {
  for (StudyRow& row : study.table1) row.empty = true;
  for (auto* figure : {&study.figure11, &study.figure13, &study.figure15}) {
    for (StudyRow& row : *figure) row.empty = true;
  }
}

Verdict verdict(const ReadingStudy& study, const std::string& number) {
  for (const Verdict& verdict : verdicts(study)) {
    if (verdict.number == number) return verdict;
  }
  throw std::out_of_range("no claim " + number);
}

Outcome outcome(const ReadingStudy& study, const std::string& number) {
  return verdict(study, number).outcome;
}

TEST(StudyVerdict, ThePapersOwnTablesHold) {
  for (const char* number : {"1a", "1b", "2a", "2b", "6"}) {
    const Verdict verdict = leafhull::verdict(paper_results(), number);
    EXPECT_EQ(verdict.outcome, Outcome::holds) << number;
    EXPECT_EQ(verdict.figures, verdict.paper) << number;
  }
  EXPECT_EQ(verdict(paper_results(), "1a").figures, "L&D 13,368, CTRLED 10,275, UNCTRLED 2,649");
  EXPECT_EQ(verdict(paper_results(), "1b").figures, "UNCTRLED 24,766, CTRLED 9,593, L&D 172");
  EXPECT_EQ(verdict(paper_results(), "2a").figures,
            "29% in dilated voxels, 38% in off-site vertices");
  EXPECT_EQ(verdict(paper_results(), "6").figures, "1.56 at 32, 1.49 at 64, 1.16 at 128 voxels");
}

TEST(StudyVerdict, OfItsFiguresThePaperPrintsNoNumbers) {
  for (const char* number : {"3a", "3b", "4a", "4b", "5a", "5b"}) {
    EXPECT_EQ(outcome(paper_results(), number), Outcome::open) << number;
    EXPECT_EQ(verdict(paper_results(), number).paper, "") << number;
  }
}

TEST(StudyVerdict, TheSameClaimsInTheSameOrder) {
  const std::vector<Verdict> nothing = verdicts({}), paper = verdicts(paper_results());
  ASSERT_EQ(nothing.size(), paper.size());
  for (std::size_t i = 0; i < paper.size(); ++i) {
    EXPECT_EQ(nothing[i].number, paper[i].number);
    EXPECT_EQ(nothing[i].claim, paper[i].claim);
    EXPECT_EQ(nothing[i].test, paper[i].test);
    EXPECT_NE(nothing[i].figures, "") << "says why it is open";
    EXPECT_EQ(nothing[i].outcome, Outcome::open) << nothing[i].number;
  }
}

TEST(StudyVerdict, OrderIsStrict) {
  EXPECT_EQ(outcome(table1({30, 10, 20}, {1, 3, 2}), "1a"), Outcome::holds);
  EXPECT_EQ(outcome(table1({30, 10, 20}, {1, 3, 2}), "1b"), Outcome::holds);
  EXPECT_EQ(outcome(table1({30, 10, 30}, {1, 3, 1}), "1a"), Outcome::fails);
  EXPECT_EQ(outcome(table1({30, 10, 30}, {1, 3, 1}), "1b"), Outcome::fails);
  EXPECT_EQ(outcome(table1({30, 10, 10}, {1, 3, 3}), "1a"), Outcome::fails);
  EXPECT_EQ(outcome(table1({30, 10, 10}, {1, 3, 3}), "1b"), Outcome::fails);
  EXPECT_EQ(outcome(table1({10, 30, 20}, {3, 1, 2}), "1a"), Outcome::fails);
  EXPECT_EQ(outcome(table1({10, 30, 20}, {3, 1, 2}), "1b"), Outcome::fails);
}

TEST(StudyVerdict, NothingToCountIsNoOrder) {
  const ReadingStudy study = table1({30, 10, 20}, {0, 0, 0});
  EXPECT_EQ(outcome(study, "1a"), Outcome::holds);
  EXPECT_EQ(outcome(study, "1b"), Outcome::open);
  EXPECT_EQ(outcome(table1({0, 0, 0}, {1, 3, 2}), "1a"), Outcome::open);
}

TEST(StudyVerdict, BetweenIsStrict) {
  EXPECT_EQ(verdict(table1({200, 100, 150}, {0, 1000, 250}), "2a").figures,
            "50% in dilated voxels, 25% in off-site vertices");
  EXPECT_EQ(outcome(table1({200, 100, 200}, {0, 1000, 250}), "2a"), Outcome::fails);
  EXPECT_EQ(outcome(table1({200, 100, 150}, {0, 1000, 1000}), "2a"), Outcome::fails);
  EXPECT_EQ(outcome(table1({200, 100, 90}, {0, 1000, 250}), "2a"), Outcome::fails);
  EXPECT_EQ(verdict(table1({200, 100, 210}, {0, 1000, 997}), "2a").figures,
            "-10% in dilated voxels, 99.7% in off-site vertices");
}

TEST(StudyVerdict, ClearOfBothIsATenthAway) {
  EXPECT_EQ(outcome(table1({200, 100, 150}, {0, 1000, 110}), "2b"), Outcome::holds);
  EXPECT_EQ(outcome(table1({200, 100, 150}, {0, 1000, 90}), "2b"), Outcome::fails);
  EXPECT_EQ(outcome(table1({200, 100, 105}, {0, 1000, 110}), "2b"), Outcome::fails);
  EXPECT_EQ(outcome(table1({200, 100, 105}, {0, 1000, 90}), "2a"), Outcome::holds);
}

BandStudy band_study() {
  BandStudy band;
  band.isotropic = row(100, 0);
  band.uncontrolled = row(0, 1000);
  return band;
}

BandRow band_row(Band band, std::uint64_t dilated, std::uint64_t off_site) {
  return {band, row(dilated, off_site)};
}

std::string words_of_2b(const BandStudy& band) {
  for (const Verdict& verdict : verdicts(table1({200, 100, 150}, {0, 1000, 90}), &band)) {
    const std::size_t words = verdict.figures.find("; ");
    if (verdict.number == "2b") {
      EXPECT_EQ(verdict.outcome, Outcome::fails) << "bands decide nothing";
      return verdict.figures.substr(words + 2);
    }
    EXPECT_EQ(verdict.figures.find("band"), std::string::npos) << verdict.number;
  }
  return "";
}

TEST(StudyVerdict, ClearOfBothNamesTheBands) {
  BandStudy band = band_study();
  EXPECT_EQ(words_of_2b(band), "by “Where the band lies” it holds for no band");
  band.by_share = {band_row({80, 100, true}, 99, 100), band_row({60, 80, true}, 80, 110),
                   band_row({40, 60, true}, 60, 300), band_row({20, 40, true}, 40, 899),
                   band_row({0, 20, true}, 20, 900)};
  EXPECT_EQ(words_of_2b(band), "by “Where the band lies” it holds for the bands 60–80% to 20–40%");
  band.by_share[2].row = row(5, 300);
  band.by_deviation = {band_row({0, 2}, 99, 1), band_row({-0.5, 0}, 50, 500)};
  EXPECT_EQ(words_of_2b(band),
            "by “Where the band lies” it holds for the bands 60–80%, 20–40% and -0.5 to 0 s");
  band.failure = "no T does";
  EXPECT_EQ(words_of_2b(band), "no other bands could be tried");
}

TEST(StudyVerdict, BetweenTwoThatAreTheSameIsNowhere) {
  EXPECT_EQ(outcome(table1({200, 100, 150}, {7, 7, 8}), "2a"), Outcome::open);
  EXPECT_EQ(outcome(table1({200, 100, 250}, {7, 7, 8}), "2a"), Outcome::fails)
      << "the other count decides";
}

TEST(StudyVerdict, AMethodWithoutASurfaceIsNamed) {
  ReadingStudy study = table1({30, 0, 20}, {1, 9, 2});
  study.table1[1].empty = true;
  EXPECT_EQ(verdict(study, "1a").figures, "L&D 30, CTRLED 20, UNCTRLED 0 (no surface)");
  EXPECT_NE(verdict(study, "2a").figures.find("UNCTRLED having no surface"), std::string::npos);
  EXPECT_EQ(outcome(study, "1a"), Outcome::holds);
  EXPECT_EQ(outcome(study, "1b"), Outcome::holds);
}

TEST(StudyVerdict, ATrendMayRestButNeverTurn) {
  EXPECT_EQ(outcome(figure11({9, 9, 8}, {1, 2, 2}), "3a"), Outcome::holds);
  EXPECT_EQ(outcome(figure11({9, 9, 8}, {1, 2, 2}), "3b"), Outcome::holds);
  EXPECT_EQ(outcome(figure11({9, 9, 9}, {2, 2, 2}), "3a"), Outcome::fails);
  EXPECT_EQ(outcome(figure11({9, 9, 9}, {2, 2, 2}), "3b"), Outcome::fails);
  EXPECT_EQ(outcome(figure11({9, 10, 8}, {1, 3, 2}), "3a"), Outcome::fails);
  EXPECT_EQ(outcome(figure11({9, 10, 8}, {1, 3, 2}), "3b"), Outcome::fails);
  EXPECT_EQ(outcome(figure11({8, 9}, {2, 1}), "3a"), Outcome::fails);
  EXPECT_EQ(outcome(figure11({8, 9}, {2, 1}), "3b"), Outcome::fails);
  EXPECT_EQ(outcome(figure13({7, 8, 9}, {1, 1, 1}), "4a"), Outcome::holds);
  EXPECT_EQ(outcome(figure13({9, 8, 7}, {1, 1, 1}), "4a"), Outcome::fails);
}

TEST(StudyVerdict, OfOnePointThereIsNoTrend) {
  EXPECT_EQ(outcome(figure11({9}, {1}), "3a"), Outcome::open);
  EXPECT_EQ(outcome(figure13({9}, {1}), "4a"), Outcome::open);
  EXPECT_EQ(outcome(figures11_and_13({1, 2}, {5}), "4b"), Outcome::open);
  EXPECT_EQ(outcome(figures11_and_13({1}, {5, 6}), "4b"), Outcome::open);
  EXPECT_EQ(outcome(figure15({9}, {1}), "5a"), Outcome::open);
  EXPECT_EQ(outcome(figure15({9}, {1}), "5b"), Outcome::open);
}

TEST(StudyVerdict, ZerosThroughoutSayNothing) {
  EXPECT_EQ(outcome(figure11({9, 8}, {0, 0}), "3b"), Outcome::open);
  EXPECT_EQ(outcome(figures11_and_13({0, 0}, {0, 0}), "4b"), Outcome::open);
  EXPECT_EQ(outcome(figure15({0, 0}, {2, 1}), "5b"), Outcome::open);
  EXPECT_EQ(outcome(figure15({0, 0}, {2, 1}), "5a"), Outcome::holds);
}

TEST(StudyVerdict, GrowthUnderTheRadiusIsLessThanUnderTheThreshold) {
  EXPECT_EQ(outcome(figures11_and_13({100, 900, 500}, {300, 350, 400}), "4b"), Outcome::holds);
  EXPECT_EQ(outcome(figures11_and_13({100, 200, 300}, {300, 400, 500}), "4b"), Outcome::fails);
  EXPECT_EQ(outcome(figures11_and_13({100, 200, 300}, {300, 300, 900}), "4b"), Outcome::fails);
  EXPECT_EQ(outcome(figures11_and_13({100, 200, 300}, {300, 200, 100}), "4b"), Outcome::holds)
      << "a fall is less than any growth";
  EXPECT_EQ(outcome(figures11_and_13({300, 200, 100}, {300, 300, 300}), "4b"), Outcome::fails)
      << "but not less than a greater fall";
  EXPECT_EQ(
      verdict(figures11_and_13({1100, 2200, 3300}, {300, 200, 270}), "4b").figures,
      "R_max 1.4 to 1.6: 30 fewer, T 1.5 to 2.5: 2,200 more; for each percent of the parameter "
      "2.3 fewer and 44 more");
}

TEST(StudyVerdict, LambdaIsLowered) {
  EXPECT_EQ(outcome(figure15({9, 9, 9}, {3, 2, 1}), "5a"), Outcome::holds);
  EXPECT_EQ(outcome(figure15({9, 9, 9}, {1, 2, 3}), "5a"), Outcome::fails);
  EXPECT_EQ(verdict(figure15({9, 9, 9}, {3, 2, 1}), "5a").figures, "lambda_R 0.8 to 0.6: 1, 2, 3");
}

TEST(StudyVerdict, LittleIsATenth) {
  EXPECT_EQ(outcome(figure15({90, 100, 95}, {3, 2, 1}), "5b"), Outcome::holds);
  EXPECT_EQ(outcome(figure15({89, 100, 95}, {3, 2, 1}), "5b"), Outcome::fails);
  EXPECT_EQ(outcome(figure15({100, 50, 100}, {3, 2, 1}), "5b"), Outcome::fails)
      << "what happens between counts";
}

TEST(StudyVerdict, ControlCostsMoreAtEveryResolution) {
  const StudyTime more{.resolution = 32, .runs = 5, .previous = 2, .proposed = 3, .control = 0.75};
  const StudyTime less{.resolution = 64, .runs = 5, .previous = 2, .proposed = 2, .control = 0.5};
  const StudyTime none{.resolution = 128, .runs = 5, .empty = true};
  EXPECT_EQ(outcome(table2({more, more}), "6"), Outcome::holds);
  EXPECT_EQ(outcome(table2({more, less}), "6"), Outcome::fails);
  EXPECT_EQ(outcome(table2({more, none}), "6"), Outcome::holds);
  EXPECT_EQ(outcome(table2({none}), "6"), Outcome::open);
  EXPECT_EQ(verdict(table2({more, less, none}), "6").figures,
            "1.50 at 32, 1.00 at 64 voxels; steps 2 to 5 are 25%, 25% of CTRLED");
}

TEST(StudyVerdict, WithoutAnySurfaceEveryClaimIsOpen) {
  ReadingStudy study = table1({0, 0, 0}, {9, 9, 9});
  study.figure11 = figure11({0, 0, 0}, {9, 9, 9}).figure11;
  study.figure13 = figure13({0, 0, 0}, {9, 9, 9}).figure13;
  study.figure15 = figure15({0, 0, 0}, {9, 9, 9}).figure15;
  study.table2 = {{.resolution = 64, .runs = 5, .empty = true}};
  lose_every_surface(study);
  for (const Verdict& verdict : verdicts(study)) {
    EXPECT_EQ(verdict.outcome, Outcome::open) << verdict.number;
    EXPECT_NE(verdict.figures.find("surface"), std::string::npos) << verdict.figures;
  }
}

}  // namespace
}  // namespace leafhull
