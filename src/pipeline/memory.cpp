// SPDX-License-Identifier: Apache-2.0
#include "pipeline/memory.h"

#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <limits>
#include <string>

#include "density/band.h"
#include "leafhull/error.h"
#include "text/numbers.h"

namespace leafhull {
namespace {

// Measured on real trees at 256 and 512 voxels, in thin and painterly. It covers the grid, the mesh
// and the scratch space for moving its vertices.
constexpr double kBytesPerVoxel = 23;
// Samples grow with this power of the resolution: a band like an ever finer surface, dense samples
// like a volume.
constexpr double kBandPower = 2.4;
constexpr double kDensePower = 3;
constexpr double kCoarseResolution = 128;

std::uint64_t meminfo_available() {
  std::ifstream meminfo("/proc/meminfo");
  for (std::string line; std::getline(meminfo, line);) {
    unsigned long long kib = 0;
    if (std::sscanf(line.c_str(), "MemAvailable: %llu kB", &kib) == 1) return kib * 1024;
  }
  return std::numeric_limits<std::uint64_t>::max();
}

/// Bytes that the control group (version 2) still allows, not counting cached files as used; the
/// largest number if there is no limit.
std::uint64_t cgroup_available() {
  const std::string folder = "/sys/fs/cgroup/";
  std::ifstream limit(folder + "memory.max"), used(folder + "memory.current");
  std::uint64_t max = 0, current = 0, cached = 0;
  if (!(limit >> max) || !(used >> current)) return std::numeric_limits<std::uint64_t>::max();
  std::ifstream stat(folder + "memory.stat");
  for (std::string line; std::getline(stat, line);) {
    unsigned long long bytes = 0;
    if (std::sscanf(line.c_str(), "inactive_file %llu", &bytes) == 1) cached = bytes;
  }
  current -= std::min(current, cached);
  return max - std::min(max, current);
}

std::uint64_t address_space_available() {
  rlimit limit{};
  std::uint64_t pages = 0;
  if (getrlimit(RLIMIT_AS, &limit) != 0 || limit.rlim_cur == RLIM_INFINITY ||
      !(std::ifstream("/proc/self/statm") >> pages)) {
    return std::numeric_limits<std::uint64_t>::max();
  }
  const std::uint64_t used = pages * static_cast<std::uint64_t>(sysconf(_SC_PAGESIZE));
  return limit.rlim_cur - std::min<std::uint64_t>(limit.rlim_cur, used);
}

/// The number of samples on a lattice of voxel size `h` over the grown box.
double dense_samples(const Box& bounds, double radius_max, double h) {
  const Vec3d size = bounds.size() + Vec3d(2 * radius_max, 2 * radius_max, 2 * radius_max);
  const auto along = [&](double length) { return length / h + kRootEdge; };
  return along(size.x) * along(size.y) * along(size.z);
}

/// The number of samples that would be evaluated on the lattice of `kernels`.
double evaluated_samples(const KernelSet& kernels, const FieldOptions& options,
                         std::span<const double> thresholds) {
  double bricks = 0;
  BandOptions band{.thresholds = {}, .falloff = options.kernels.density.falloff};
  if (!options.dense) band.thresholds.assign(thresholds.begin(), thresholds.end());
  find_band(kernels, band,
            [&](const BrickList& list, double) { bricks += static_cast<double>(list.size()); });
  return bricks * kBrickSamples;
}

}  // namespace

std::uint64_t available_memory() {
  return std::min({meminfo_available(), cgroup_available(), address_space_available()});
}

std::uint64_t resident_memory() {
  std::uint64_t pages = 0, resident = 0;
  std::ifstream("/proc/self/statm") >> pages >> resident;
  return resident * static_cast<std::uint64_t>(sysconf(_SC_PAGESIZE));
}

std::uint64_t peak_memory() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return static_cast<std::uint64_t>(usage.ru_maxrss) * 1024;
}

FieldMemory::FieldMemory(std::span<const Kernel> kernels, std::shared_ptr<const SpatialHash> hash,
                         const Box& bounds, const Grid& grid, const FieldOptions& options,
                         std::span<const double> thresholds, std::uint64_t available)
    : resolution_(grid.resolution),
      power_(options.dense ? kDensePower : kBandPower),
      needed_(kBytesPerVoxel * dense_samples(bounds, grid.radius_max, options.voxel_size)),
      available_(static_cast<double>(available)) {
  if (fits()) return;
  const double finer = std::max(1.0, grid.resolution / kCoarseResolution);
  const KernelSet coarse(kernels, std::move(hash),
                         Lattice::near(bounds.low, options.voxel_size * finer),
                         options.kernels.density.falloff);
  needed_ =
      kBytesPerVoxel * evaluated_samples(coarse, options, thresholds) * std::pow(finer, power_);
}

void FieldMemory::check() const {
  if (fits()) return;
  constexpr double kGiB = 1 << 30;
  constexpr double kToSpare = 0.98;  // what is available changes from run to run
  const std::string largest =
      fixed(std::floor(kToSpare * resolution_ * std::pow(available_ / needed_, 1 / power_)), 0);
  throw Error(ErrorCode::usage,
              "a resolution of " + std::to_string(resolution_) + " voxels needs about " +
                  significant(needed_ / kGiB, 3) + " GiB, and " +
                  significant(available_ / kGiB, 3) + " GiB are available",
              "The largest resolution that fits here is about " + largest + " (--resolution " +
                  largest + ").");
}

}  // namespace leafhull
