// SPDX-License-Identifier: Apache-2.0
#include "device/evaluator.h"

#include <algorithm>

#include "device/engine.h"
#include "leafhull/error.h"

namespace leafhull {

namespace {

constexpr std::size_t kWorkItems = 256;  // per brick, as in density_work_item.cl
constexpr std::size_t kPointsPerGroup = 64;
// PoCL compiles a kernel again for grids of 65,536 groups and more.
constexpr std::size_t kBricksPerLaunch = 1 << 15;

}  // namespace

struct Evaluator::Impl {
  Device::Engine& engine;
  int falloff;
  cl::Buffer kernels;

  /// Runs a kernel over the points of a batch.
  template <class... Arguments>
  void over_points(const char* name, const PointBatch& batch, const Arguments&... arguments) {
    cl::Kernel kernel = engine.kernel(name, falloff);
    const cl::Buffer chunks = engine.input(batch.chunks), list = engine.input(batch.kernels);
    const auto count = static_cast<cl_uint>(batch.chunks.size());
    set_arguments(kernel, kernels, chunks, count, list, arguments...);
    const std::size_t group = engine.vector() ? 1 : kPointsPerGroup;
    const std::size_t items = engine.vector() ? count : count * engine.chunk_points();
    engine.queue.enqueueNDRangeKernel(kernel, cl::NullRange,
                                      cl::NDRange((items + group - 1) / group * group),
                                      cl::NDRange(group));
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
    for (std::size_t begin = 0; begin < bricks.size(); begin += kBricksPerLaunch) {
      const std::size_t count = std::min(kBricksPerLaunch, bricks.size() - begin);
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

std::vector<float> Evaluator::density(const PointBatch& batch) {
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
  points.chunks.resize(1);
  points.chunk_points = nothing.chunk_points();
  points.index.resize(points.chunk_points);
  for (auto* v : {&points.x, &points.y, &points.z}) v->resize(points.chunk_points);
  nothing.density(points);
  nothing.snap(points, 1, 1);
}

}  // namespace leafhull
