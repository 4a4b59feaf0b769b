// SPDX-License-Identifier: Apache-2.0
#include "study/study_plan.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>
#include <tuple>

namespace leafhull {
namespace {

auto key(const Reading& reading) {
  return std::tuple(reading.falloff, reading.spread, reading.density);
}

std::vector<double> values(const std::vector<StudyRow>& rows, double StudyRow::*parameter) {
  std::vector<double> values;
  for (const StudyRow& row : rows) values.push_back(row.*parameter);
  return values;
}

TEST(StudyPlan, EveryReadingOnceTheProjectsOwnFirst) {
  std::set<decltype(key(Reading{}))> different;
  for (const Reading& reading : readings()) different.insert(key(reading));
  EXPECT_EQ(different.size(), readings().size());
  EXPECT_EQ(key(readings().front()), key(Reading{}));
  const Options own;
  EXPECT_EQ(key(Reading{}), std::tuple(own.falloff, own.spread, own.density));
}

TEST(StudyPlan, ThePapersValues) {
  const ReadingStudy study = planned({});
  EXPECT_EQ(values(study.figure11, &StudyRow::threshold),
            (std::vector<double>{1.5, 1.75, 2, 2.25, 2.5}));
  EXPECT_EQ(values(study.figure13, &StudyRow::radius_max),
            (std::vector<double>{1.4, 1.45, 1.5, 1.55, 1.6}));
  EXPECT_EQ(values(study.figure15, &StudyRow::flatness),
            (std::vector<double>{0.6, 0.65, 0.7, 0.75, 0.8}));
  for (const Method method : {Method::isotropic, Method::uncontrolled, Method::controlled}) {
    const StudyRow& row = study.table1[static_cast<std::size_t>(method)];
    EXPECT_EQ(row.method, method);
    EXPECT_EQ(row.threshold, 2);
    EXPECT_EQ(row.radius_max, 1.5);
    EXPECT_EQ(row.flatness, 0.7);
  }
}

TEST(StudyPlan, ARowAsksForItselfAlone) {
  const Reading reading{1, Spread::variance, DensitySource::grid};
  const StudyRow row = planned(reading).figure15.front();
  const Options options = resolve(options_of(row, reading, 32));
  EXPECT_EQ(options.method, Method::controlled);
  EXPECT_EQ(options.threshold, 2);
  EXPECT_EQ(options.radius_max, 1.5);
  EXPECT_EQ(options.radius_unit, RadiusUnit::crown);
  EXPECT_EQ(options.flatness, 0.6);
  EXPECT_EQ(options.min_component, 0) << "the paper keeps what is small";
  EXPECT_EQ(options.hollows, Hollows::keep) << "and what is hollow";
  EXPECT_EQ(options.resolution, 32);
  EXPECT_EQ(options.falloff, 1);
  EXPECT_EQ(options.spread, Spread::variance);
  EXPECT_EQ(options.density, DensitySource::grid);
}

TEST(StudyPlan, ServesEveryRowAndRepeatsNoExtraction) {
  std::vector<ReadingStudy> studies;
  for (const Reading& reading : readings()) studies.push_back(planned(reading));
  const Plan plan = leafhull::plan(studies);
  // The middle row of every figure is Table 1's CTRLED.
  EXPECT_EQ(plan.options.size(), readings().size() * (3 + 3 * 4));
  ASSERT_EQ(plan.rows.size(), plan.options.size());

  std::set<const StudyRow*> served;
  for (std::size_t i = 0; i < plan.rows.size(); ++i) {
    for (const StudyRow* row : plan.rows[i]) {
      EXPECT_TRUE(served.insert(row).second);
      EXPECT_EQ(row->method, plan.options[i].method);
      EXPECT_EQ(row->threshold, plan.options[i].threshold);
      EXPECT_EQ(row->radius_max, plan.options[i].radius_max);
      EXPECT_EQ(row->flatness, plan.options[i].flatness);
    }
  }
  EXPECT_EQ(served.size(), readings().size() * (3 + 3 * 5));
  for (const ReadingStudy& study : studies) {
    const auto first = std::find_if(plan.rows.begin(), plan.rows.end(), [&](const auto& rows) {
      return rows.front() == study.table1.data();
    });
    ASSERT_NE(first, plan.rows.end());
    const Options& options = plan.options[static_cast<std::size_t>(first - plan.rows.begin())];
    EXPECT_EQ(key({options.falloff, options.spread, options.density}), key(study.reading));
  }
}

}  // namespace
}  // namespace leafhull
