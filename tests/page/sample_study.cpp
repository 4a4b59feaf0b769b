// SPDX-License-Identifier: Apache-2.0
#include "page/sample_study.h"

#include "unit/output_sample.h"

namespace leafhull::test {
namespace {

StudyRow row(Method method, double threshold, std::uint64_t dilated, std::uint64_t off_site) {
  StudyRow row;
  row.method = method;
  row.threshold = threshold;
  row.radius_max = 1.5;
  row.flatness = 0.7;
  row.metrics.dilated_voxels = dilated;
  row.metrics.off_site_sampled = off_site;
  return row;
}

StudyRow empty_row(Method method) {
  StudyRow row;
  row.method = method;
  row.empty = true;
  return row;
}

ReadingStudy reading_study(const Reading& reading, Outcome second) {
  ReadingStudy study;
  study.reading = reading;
  study.table1 = {row(Method::isotropic, 2, 4000, 100), empty_row(Method::uncontrolled),
                  row(Method::controlled, 2, 3000, 250)};
  study.figure11 = {row(Method::controlled, 1.5, 3600, 200),
                    row(Method::controlled, 2.25, 2400, 300)};
  study.figure13 = study.figure11;
  study.figure15 = study.figure11;
  study.table2 = {{.resolution = 32, .runs = 5, .previous = 0.5, .proposed = 0.75, .control = 0.2},
                  {.resolution = 64, .runs = 5, .empty = true}};
  study.verdicts = {
      {"1", "L&D swells more than CTRLED.", "R_max > 1", Outcome::holds, "4,000 > 3,000", "13,368"},
      {"2", "Raising R_max swells.", "lambda_R < 1", second, "1 < 2", ""},
      {"3", "Control takes time.", "over 1", Outcome::open, "nothing to compare", ""}};
  return study;
}

LabelledPicture picture(const std::string& label) {
  return {{2, 1, {255, 255, 255, 60, 120, 60}}, {label}};
}

BandStudy band_study() {
  BandStudy band;
  band.evenness = 0.527;
  band.threshold = 4.4695;
  band.leaf_scale = 2.5;
  band.isotropic = row(Method::isotropic, 4.4695, 4000, 6);
  band.uncontrolled = row(Method::uncontrolled, 4.4695, 1000, 940);
  band.by_share = {{{80, 100, true}, row(Method::controlled, 4.4695, 3900, 8)},
                   {{0, 20, true}, row(Method::controlled, 4.4695, 2000, 500)}};
  band.by_deviation = {{{0, 2}, row(Method::controlled, 4.4695, 3800, 10)}};
  return band;
}

TreeStudy tree_study(const std::string& name) {
  TreeStudy tree;
  tree.name = name;
  tree.leaves = 500;
  tree.leaf_vertices = 2000;
  tree.readings = {reading_study({2, Spread::stddev, DensitySource::exact}, Outcome::fails),
                   reading_study({1, Spread::variance, DensitySource::grid}, Outcome::holds)};
  tree.band = band_study();
  tree.methods = {picture("L&D"), picture("UNCTRLED"), picture("CTRLED")};
  tree.figure12 = {picture("T = 1.5"), picture("T = 2.25")};
  tree.figure14 = {picture("R_max = 1.5")};
  tree.meshes = {sphere(12), Mesh{}, sphere(8)};
  tree.bounds.include({-2, -2, -2});
  tree.bounds.include({2, 2, 2});
  tree.seconds = 12.3;
  return tree;
}

}  // namespace

Study sample_study() {
  Study study;
  study.trees = {tree_study("birch"), tree_study(kMarkup)};
  study.version = "1.2.3";
  study.device = "a device";
  study.machine = "a machine";
  study.date = "2026-11-22";
  study.command = "leafhull study 'a tree.glb' -o <it>";
  study.seconds = 123;
  return study;
}

}  // namespace leafhull::test
