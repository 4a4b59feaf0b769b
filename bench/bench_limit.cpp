// SPDX-License-Identifier: Apache-2.0
// The device's peak rates and, with --pairs, what the engine reaches in each stage.
#include <algorithm>
#include <cmath>
#include <iostream>
#include <string>
#include <string_view>

#include "bench/contender.h"
#include "bench/kernel_clock.h"
#include "bench/leafhull_case.h"
#include "bench/pairs.h"
#include "density/control.h"
#include "device/engine.h"
#include "points/leaf_points.h"

namespace leafhull {
extern const std::string_view kernel_source_limit;
}

namespace leafhull::bench {
namespace {

constexpr int kRounds = 5;

// Floating-point operations per evaluated pair, a fused multiply-add counting two: what the kernels
// are written to do, whatever the compiler saves.
/// density_vector.cl: per sample an FMA, a maximum, and an FMA for k = 2; per 4 samples along x
/// 7 FMAs and 3 additions.
constexpr double kFieldFlops = 2 + 1 + 2 + (14 + 3) / 4.0;
/// density_points of points.cl: 3 subtractions, the 3 rows of U (5, 3 and 1), 3 FMAs, a maximum,
/// and an FMA.
constexpr double kPointFlops = 3 + 9 + 6 + 1 + 2;

double best_seconds(const char* kernel, const std::function<void()>& launch) {
  double best = HUGE_VAL;
  for (int round = 0; round <= kRounds; ++round) {  // the first one compiles
    launch();
    const double seconds = take_kernel_seconds().at(kernel);
    if (round > 0) best = std::min(best, seconds);
  }
  return best;
}

cl::Kernel limit_kernel(Device::Engine& engine, const char* name) {
  return {engine.build({std::string(kernel_source_limit)}, "-cl-std=CL1.2"), name};
}

double fma_gflops(Device::Engine& engine) {
  constexpr double kFlopsPerStep = 2 * 16 * 12;  // as in limit.cl
  const std::size_t items = static_cast<std::size_t>(engine.info.compute_units) * 1024;
  const cl::NDRange group(engine.vector() ? 1 : 64);
  const cl::Buffer out(engine.context, CL_MEM_WRITE_ONLY, items * sizeof(float));
  cl::Kernel kernel = limit_kernel(engine, "fma_chains");
  kernel.setArg(0, 0.5f);
  kernel.setArg(2, out);
  double best = 0;
  for (cl_int steps = 1024;; steps *= 4) {
    kernel.setArg(1, steps);
    const double seconds = best_seconds("fma_chains", [&] {
      engine.queue.enqueueNDRangeKernel(kernel, cl::NullRange, cl::NDRange(items), group);
    });
    best = std::max(best, 1e-9 * kFlopsPerStep * steps * static_cast<double>(items) / seconds);
    if (seconds > 0.05) return best;
  }
}

/// The triad's rate as STREAM counts it: two arrays read, one written.
double triad_gigabytes(Device::Engine& engine) {
  constexpr std::size_t kBytes = std::size_t{128} << 20;
  std::vector<cl::Buffer> arrays;
  for (int i = 0; i < 3; ++i) {
    arrays.emplace_back(engine.context, CL_MEM_READ_WRITE, kBytes);
    engine.queue.enqueueFillBuffer(arrays.back(), 1.0f, 0, kBytes);
  }
  cl::Kernel kernel = limit_kernel(engine, "triad");
  kernel.setArg(0, 0.5f);
  for (cl_uint i = 0; i < 3; ++i) kernel.setArg(1 + i, arrays[i]);
  const double seconds = best_seconds("triad", [&] {
    engine.queue.enqueueNDRangeKernel(kernel, cl::NullRange,
                                      cl::NDRange(kBytes / sizeof(cl_float16)));
  });
  return 1e-9 * 3 * static_cast<double>(kBytes) / seconds;
}

/// Seconds that the device spends in each stage of an extraction, the best of some rounds.
std::map<std::string, double> seconds_by_stage(const LeafSet& leaves, const Options& options,
                                               Device& device) {
  std::map<std::string, double> best;
  for (int round = 0; round <= kRounds; ++round) {  // the first one compiles
    std::map<std::string, double> seconds;
    std::string current;
    const auto enter = [&](std::string_view stage) {
      for (const auto& [kernel, s] : take_kernel_seconds()) seconds[current] += s;
      current = stage;
    };
    extract(leaves, options, device, [&](const Advance& now) {
      if (now.stage != current) enter(now.stage);
    });
    enter("");
    if (round == 0) continue;
    for (const auto& [stage, s] : seconds) {
      best[stage] = round == 1 ? s : std::min(best[stage], s);
    }
  }
  return best;
}

struct Pairs {
  std::uint64_t inside = 0;
  std::uint64_t evaluated = 0;
  double flops = 0;  ///< per evaluated pair
};

Json stages_of(const Case& c, Method method, Device& device, double peak) {
  const LeafSet leaves = load_leaves(c.tree);
  const Options options = options_of(c, method);
  const std::map<std::string, double> seconds = seconds_by_stage(leaves, options, device);
  const Shape shape = extract(leaves, options, device);
  const std::vector<Kernel> isotropic =
      isotropic_kernels(vertex_points(leaves).points, c.radius, options.falloff);
  const std::map<std::string, Pairs> pairs = {
      {"isotropic density",
       {pairs_inside(isotropic, leaves.vertices),
        pairs_evaluated(isotropic, leaves, c.radius, options.falloff), kPointFlops}},
      {"threshold",
       {pairs_inside(shape.kernels, leaves.vertices),
        pairs_evaluated(shape.kernels, leaves, c.radius, options.falloff), kPointFlops}},
      {"field",
       {pairs_inside(shape.kernels, *shape.field), shape.report.counts.evaluated_pairs,
        kFieldFlops}}};
  Json stages;
  for (const auto& [stage, s] : seconds) {
    Json& row = stages[stage];
    row["device_seconds"] = s;
    const auto found = pairs.find(stage);
    if (found == pairs.end()) continue;
    const auto& [inside, evaluated, flops] = found->second;
    row["pairs_inside"] = inside;
    row["pairs_evaluated"] = evaluated;
    const double gflops = 1e-9 * flops * static_cast<double>(evaluated) / s;
    row["flops_per_pair"] = flops;
    row["gflops"] = gflops;
    row["share_of_peak"] = gflops / peak;
  }
  return stages;
}

void measure(const std::filesystem::path& case_file, Method method, const DeviceOptions& options) {
  Device device(options);
  start_kernel_clock(device);
  const double peak = fma_gflops(device.engine());
  Json page = {{"device", device.info().name},
               {"platform", device.info().platform},
               {"driver", device.info().driver},
               {"variant", device.info().variant},
               {"compute_units", device.info().compute_units},
               {"fma_gflops", peak},
               {"bandwidth_gbs", triad_gigabytes(device.engine())}};
  if (!case_file.empty()) {
    const Case c = read_case(case_file);
    page["case"] = c.name;
    page["method"] = name(method);
    page["stages"] = stages_of(c, method, device, peak);
  }
  std::cout << page.dump() << std::endl;
}

}  // namespace
}  // namespace leafhull::bench

int main(int argc, char** argv) {
  CLI::App app("The device's limits: fused multiply-adds and memory bandwidth.");
  std::filesystem::path case_file;
  leafhull::Method method = leafhull::Method::controlled;
  leafhull::DeviceOptions options;
  app.add_option("--pairs", case_file, "a case whose pairs and stages are measured, too");
  leafhull::bench::add_method(app, method);
  app.add_option("--device", options.choice, "index or part of a name");
  app.add_option("--threads", options.threads, "the most that may be used; 0: all cores");
  CLI11_PARSE(app, argc, argv);
  try {
    leafhull::bench::measure(case_file, method, options);
    return 0;
  } catch (const std::exception& error) {
    std::cerr << "bench_limit: " << error.what() << '\n';
    return 1;
  }
}
