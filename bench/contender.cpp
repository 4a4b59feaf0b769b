// SPDX-License-Identifier: Apache-2.0
#include "bench/contender.h"

#include <sys/resource.h>

#include <fstream>
#include <iostream>
#include <stdexcept>

namespace leafhull::bench {
namespace {

template <class T>
std::optional<T> optional_value(const Json& page, const char* key) {
  return page.at(key).is_null() ? std::nullopt : std::optional(page.at(key).get<T>());
}

template <class T>
Json or_null(const std::optional<T>& value) {
  return value ? Json(*value) : Json();
}

void say(const Json& line) { std::cout << line.dump() << std::endl; }

std::uint64_t peak_memory_bytes() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return static_cast<std::uint64_t>(usage.ru_maxrss) * 1024;
}

void answer_runs(const Contender& contender) {
  say({{"ready", true},
       {"name", contender.name},
       {"version", contender.version},
       {"threads", contender.threads},
       {"setup", contender.setup}});
  for (std::string line; std::getline(std::cin, line) && line != "quit";) {
    if (line != "run") throw std::runtime_error("a line is neither run nor quit: " + line);
    Json result = contender.run();
    result["peak_memory_bytes"] = peak_memory_bytes();
    say(result);
  }
}

}  // namespace

Case read_case(const std::filesystem::path& file) {
  std::ifstream in(file);
  if (!in) throw std::runtime_error(file.string() + " cannot be read");
  try {
    const Json page = Json::parse(in);
    return {.name = page.at("name"),
            .tree = page.at("tree"),
            .points = page.at("points").get<std::string>(),
            .frames = page.at("frames").get<std::string>(),
            .count = page.at("count"),
            .style = page.at("style"),
            .radius = page.at("radius"),
            .voxel = page.at("voxel"),
            .resolution = page.at("resolution"),
            .threshold = optional_value<double>(page, "threshold"),
            .coverage = optional_value<double>(page, "coverage"),
            .flatness = page.at("flatness"),
            .min_component = page.at("min_component")};
  } catch (const Json::exception& error) {
    throw std::runtime_error(file.string() + " is no case: " + error.what());
  }
}

void write_case(const Case& c, const std::filesystem::path& file) {
  const Json page = {{"name", c.name},
                     {"tree", c.tree},
                     {"points", c.points.string()},
                     {"frames", c.frames.string()},
                     {"count", c.count},
                     {"style", c.style},
                     {"radius", c.radius},
                     {"voxel", c.voxel},
                     {"resolution", c.resolution},
                     {"threshold", or_null(c.threshold)},
                     {"coverage", or_null(c.coverage)},
                     {"flatness", c.flatness},
                     {"min_component", c.min_component}};
  std::ofstream out(file);
  out << page.dump(2) << '\n';
  if (!out.flush()) throw std::runtime_error(file.string() + " cannot be written");
}

std::vector<double> read_doubles(const std::filesystem::path& file, std::size_t count) {
  std::vector<double> values(count);
  std::ifstream in(file, std::ios::binary);
  const auto bytes = static_cast<std::streamsize>(count * sizeof(double));
  in.read(reinterpret_cast<char*>(values.data()), bytes);
  if (!in || in.peek() != std::ifstream::traits_type::eof()) {
    throw std::runtime_error(file.string() + " does not hold " + std::to_string(count) +
                             " doubles");
  }
  return values;
}

void write_doubles(const std::vector<double>& values, const std::filesystem::path& file) {
  std::ofstream out(file, std::ios::binary);
  out.write(reinterpret_cast<const char*>(values.data()),
            static_cast<std::streamsize>(values.size() * sizeof(double)));
  if (!out.flush()) throw std::runtime_error(file.string() + " cannot be written");
}

std::vector<Vec3d> read_points(const Case& c) {
  const std::vector<double> values = read_doubles(c.points, 3 * c.count);
  std::vector<Vec3d> points;
  points.reserve(c.count);
  for (std::size_t i = 0; i < values.size(); i += 3) {
    points.emplace_back(values[i], values[i + 1], values[i + 2]);
  }
  return points;
}

int serve(CLI::App& app, int argc, char** argv,
          const std::function<Contender(const Case&, int threads)>& prepare) {
  std::filesystem::path file;
  int threads = 0;
  app.add_option("CASE", file, "a case that bench_case wrote")->required();
  app.add_option("--threads", threads, "the most that may be used; 0: all cores")
      ->check(CLI::NonNegativeNumber);
  try {
    app.parse(argc, argv);
    answer_runs(prepare(read_case(file), threads));
    return 0;
  } catch (const CLI::CallForHelp&) {
    std::cout << app.help();
    return 0;
  } catch (const std::exception& error) {
    say({{"error", error.what()}});
    return 1;
  }
}

}  // namespace leafhull::bench
