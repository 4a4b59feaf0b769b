// SPDX-License-Identifier: Apache-2.0
#include "device/evaluator.h"

#include <algorithm>

#include "device/engine.h"
#include "leafhull/error.h"

namespace leafhull {

namespace {

constexpr std::size_t kWorkItems = 256;  // per brick, as in density_work_item.cl
// PoCL compiles a kernel again for grids of 65,536 groups and more.
constexpr std::size_t kMostPerLaunch = 1 << 15;  // bricks or groups of points
/// Scratch space of a launch: entries of lists for each compute unit, 2.6 MiB, which stay in a
/// CPU's caches. There may be more where some groups have long lists, up to 180 MiB or one group,
/// so that every unit has work.
constexpr std::size_t kUnitEntries = std::size_t{1} << 16;
constexpr std::size_t kUnitGroups = 4;
constexpr std::size_t kMostEntries = std::size_t{1} << 22;

// As in points.cl.
constexpr std::size_t kRun = 32;
using NearKernel = std::array<float, 10>;
using Marks = std::array<std::uint32_t, kGroupChunks>;

/// The entries of a group's list, in whole runs.
std::size_t entries_of(const PointGroup& group) {
  return (group.end - group.first + kRun - 1) / kRun * kRun;
}

/// The launches over some groups.
struct Launches {
  std::vector<std::size_t> ends;  ///< the group where each ends
  std::size_t entries = 0;        ///< of the largest
};

/// Shares out groups among launches on so many compute units, and gives them their places in the
/// scratch space.
Launches in_launches(std::span<PointGroup> groups, std::size_t units) {
  Launches launches;
  std::size_t begin = 0, entries = 0;
  for (std::size_t g = 0; g < groups.size(); ++g) {
    const std::size_t more = entries + entries_of(groups[g]), count = g - begin;
    const bool is_full = more > units * kUnitEntries && count >= units * kUnitGroups;
    if (count > 0 && (is_full || more > kMostEntries || count == kMostPerLaunch)) {
      launches.ends.push_back(g);
      begin = g, entries = 0;
    }
    groups[g].entry = static_cast<std::uint32_t>(entries);
    entries += entries_of(groups[g]);
    launches.entries = std::max(launches.entries, entries);
  }
  if (!groups.empty()) launches.ends.push_back(groups.size());
  return launches;
}

}  // namespace

struct Evaluator::Impl {
  Device::Engine& engine;
  int falloff;
  cl::Buffer kernels;
  cl::Buffer near = {}, marks = {};  // scratch space
  std::size_t room = 0;              // entries of it

  /// Makes room in the scratch space, in which launches take turns.
  void reserve(std::size_t entries) {
    if (entries <= room) return;
    near = cl::Buffer(engine.context, CL_MEM_READ_WRITE, entries * sizeof(NearKernel));
    marks = cl::Buffer(engine.context, CL_MEM_READ_WRITE, entries / kRun * sizeof(Marks));
    room = entries;
  }

  /// Runs a kernel over the points of a batch, a launch's share at a time.
  template <class... Arguments>
  void over_points(const char* name, PointBatch& batch, const Arguments&... arguments) {
    cl::Kernel kernel = engine.kernel(name, falloff);
    const cl::Buffer list = engine.input(batch.bricks.kernels);
    const std::size_t items = engine.vector() ? 1 : kGroupChunks * batch.chunk_points;
    const auto units = static_cast<std::size_t>(std::max(engine.info.compute_units, 1));
    const Launches launches = in_launches(batch.groups, units);
    reserve(std::max(launches.entries, units * kUnitEntries));
    std::size_t begin = 0;
    for (const std::size_t end : launches.ends) {
      const auto part = [&](const auto& all) {
        return engine.buffer(std::span(all).subspan(begin, end - begin), CL_MEM_READ_ONLY);
      };
      const cl::Buffer groups = part(batch.groups), boxes = part(batch.boxes);
      set_arguments(kernel, kernels, groups, list, boxes, near, marks, arguments...);
      engine.queue.enqueueNDRangeKernel(kernel, cl::NullRange, cl::NDRange((end - begin) * items),
                                        cl::NDRange(items));
      begin = end;
    }
  }
};

Evaluator::Evaluator(Device& device, const KernelSet& kernels, int falloff)
    : impl_(new Impl{device.engine(), falloff, {}}) {
  impl_->engine.run("sending the kernels", [&] {
    impl_->kernels = impl_->engine.buffer(kernels.kernels(), CL_MEM_READ_ONLY);
  });
}

Evaluator::~Evaluator() = default;
Evaluator::Evaluator(Evaluator&&) noexcept = default;

std::size_t Evaluator::chunk_points() const { return impl_->engine.chunk_points(); }

std::uint64_t Evaluator::sample(const BrickList& bricks, std::span<float> samples) {
  Impl& d = *impl_;
  std::vector<cl_int4> origins;
  for (const Coord o : bricks.origins) origins.push_back({{o.x, o.y, o.z, 0}});
  std::vector<std::uint32_t> pairs(bricks.size());

  d.engine.run("evaluating the density", [&] {
    cl::Kernel kernel = d.engine.kernel("density_bricks", d.falloff);
    const cl::Buffer list = d.engine.input(bricks.kernels);
    const std::size_t items = d.engine.vector() ? 1 : kWorkItems;
    for (std::size_t begin = 0; begin < bricks.size(); begin += kMostPerLaunch) {
      const std::size_t count = std::min(kMostPerLaunch, bricks.size() - begin);
      const auto out = samples.subspan(begin * kBrickSamples, count * kBrickSamples);
      const auto out_pairs = std::span(pairs).subspan(begin, count);
      const cl::Buffer origins_in = d.engine.buffer(
          std::span<const cl_int4>(origins).subspan(begin, count), CL_MEM_READ_ONLY);
      const cl::Buffer first_in = d.engine.buffer(
          std::span<const std::uint32_t>(bricks.first).subspan(begin, count + 1), CL_MEM_READ_ONLY);
      const cl::Buffer samples_out = d.engine.buffer(out, CL_MEM_WRITE_ONLY);
      const cl::Buffer pairs_out = d.engine.buffer(out_pairs, CL_MEM_WRITE_ONLY);
      set_arguments(kernel, d.kernels, origins_in, first_in, list, samples_out, pairs_out);
      d.engine.queue.enqueueNDRangeKernel(kernel, cl::NullRange, cl::NDRange(count * items),
                                          cl::NDRange(items));
      d.engine.fetch(samples_out, out);
      d.engine.fetch(pairs_out, out_pairs);
    }
  });
  std::uint64_t total = 0;
  for (const std::uint32_t p : pairs) total += p;
  return total;
}

std::vector<float> Evaluator::density(PointBatch& batch) {
  Impl& d = *impl_;
  std::vector<float> density(batch.index.size());
  d.engine.run("evaluating the density at points", [&] {
    const cl::Buffer x = d.engine.input(batch.x), y = d.engine.input(batch.y),
                     z = d.engine.input(batch.z);
    const cl::Buffer out = d.engine.buffer(std::span(density), CL_MEM_WRITE_ONLY);
    d.over_points("density_points", batch, x, y, z, out);
    d.engine.fetch(out, std::span(density));
  });
  return density;
}

Evaluator::Normals Evaluator::snap(PointBatch& batch, double threshold, int steps) {
  Impl& d = *impl_;
  Normals normals;
  for (auto* v : {&normals.x, &normals.y, &normals.z}) v->resize(batch.index.size());
  d.engine.run("moving vertices onto the surface", [&] {
    std::vector<float>* const host[] = {&batch.x,   &batch.y,   &batch.z,
                                        &normals.x, &normals.y, &normals.z};
    cl::Buffer out[6];
    for (cl_uint i = 0; i < 6; ++i) {
      out[i] = d.engine.buffer(std::span(*host[i]), CL_MEM_READ_WRITE);
    }
    d.over_points("snap_points", batch, static_cast<cl_float>(threshold),
                  static_cast<cl_int>(steps), out[0], out[1], out[2], out[3], out[4], out[5]);
    for (cl_uint i = 0; i < 6; ++i) d.engine.fetch(out[i], std::span(*host[i]));
  });
  return normals;
}

void prepare(Device& device, int falloff) {
  const KernelSet no_kernels;
  Evaluator nothing(device, no_kernels, falloff);
  BrickList brick;
  brick.add(Coord{}, {});
  std::vector<float> samples(kBrickSamples);
  nothing.sample(brick, samples);
  PointBatch points;
  points.chunk_points = nothing.chunk_points();
  points.groups.resize(1);
  points.boxes.resize(1);
  nothing.density(points);
  nothing.snap(points, 1, 1);
}

}  // namespace leafhull
