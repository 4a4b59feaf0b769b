// SPDX-License-Identifier: Apache-2.0
// What the contenders of ./dev bench share: the case, the clock and the driver's protocol.
#pragma once

#include <CLI/CLI.hpp>
#include <chrono>
#include <cstddef>
#include <filesystem>
#include <functional>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "leafhull/vec.h"

namespace leafhull::bench {

using Json = nlohmann::ordered_json;

/// One job for every contender, as bench_case writes it. Lengths are in model units.
struct Case {
  std::string name;
  std::string tree;                      ///< a file or synthetic:COUNT, as load_leaves takes it
  std::filesystem::path points, frames;  ///< see write_leaves
  std::size_t count = 0;                 ///< leaf vertices
  std::string style;                     ///< "painterly" or "r1.5"
  double radius = 0;                     ///< R_max
  double voxel = 0;                      ///< h
  int resolution = 0;                    ///< voxels along the longest side
  std::optional<double> threshold;       ///< T; either this
  std::optional<double> coverage;        ///< or the fraction of leaf vertices inside
  double flatness = 1;                   ///< lambda_R
  double min_component = 0;              ///< pieces below this fraction of the largest are dropped
};

/// @throws std::runtime_error: a file that cannot be read or is no case.
Case read_case(const std::filesystem::path& file);
void write_case(const Case& c, const std::filesystem::path& file);

/// The case's leaf vertices.
std::vector<Vec3d> read_points(const Case& c);

/// A file of raw doubles. @throws std::runtime_error where it does not hold `count` of them.
std::vector<double> read_doubles(const std::filesystem::path& file, std::size_t count);
void write_doubles(const std::vector<double>& values, const std::filesystem::path& file);

/// Seconds that `work` takes on the wall's clock.
template <class Work>
double seconds_of(Work&& work) {
  const auto began = std::chrono::steady_clock::now();
  work();
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - began).count();
}

struct Contender {
  std::string name, version;
  int threads = 1;              ///< the most threads to use; 0: all cores
  Json setup = Json::object();  ///< seconds of preparation that no run repeats, by what was done
  /// One whole run from the points in memory: {"field", "mesh", "total": seconds, "vertices",
  /// "faces", ...}.
  std::function<Json()> run = {};
};

/// A contender's main: parses `app`, to which CASE and --threads are added, prints what `prepare`
/// made, and answers each line `run` on standard input with one line of JSON. A failure is one line
/// too, {"error": ...}, and the exit status 1.
int serve(CLI::App& app, int argc, char** argv,
          const std::function<Contender(const Case&, int threads)>& prepare);

}  // namespace leafhull::bench
