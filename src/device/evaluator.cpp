// SPDX-License-Identifier: Apache-2.0
#include "device/evaluator.h"

#include <algorithm>
#include <string>

#include "device/engine.h"
#include "leafhull/error.h"

namespace leafhull {

namespace {

constexpr std::size_t kChunk = 16;       // points, as in points.cl
constexpr std::size_t kWorkItems = 256;  // per brick, as in density_work_item.cl
// PoCL compiles a kernel again for grids of 65,536 groups and more.
constexpr std::size_t kBricksPerLaunch = 1 << 15;

/// `Kernel` of density.clh.
struct DeviceKernel {
  std::int32_t cell[3];
  float offset[3];
  float axes[9];
  float unused;
};
static_assert(sizeof(DeviceKernel) == 64);

/// `Chunk` of points.cl.
struct Chunk {
  std::int32_t origin[3];
  std::uint32_t first, end;
  std::uint32_t unused[3];
};
static_assert(sizeof(Chunk) == 32);

DeviceKernel to_device(const LatticeKernel& kernel) {
  DeviceKernel k{};
  k.cell[0] = kernel.cell.x, k.cell[1] = kernel.cell.y, k.cell[2] = kernel.cell.z;
  k.offset[0] = kernel.offset.x, k.offset[1] = kernel.offset.y, k.offset[2] = kernel.offset.z;
  for (std::size_t a = 0; a < 3; ++a) {
    k.axes[3 * a] = kernel.axes[a].x;
    k.axes[3 * a + 1] = kernel.axes[a].y;
    k.axes[3 * a + 2] = kernel.axes[a].z;
  }
  return k;
}

/// A batch's points in chunks of kChunk, coordinate by coordinate; the last chunk of a brick is
/// filled up with its last point.
struct Chunks {
  std::vector<Chunk> chunks;
  std::vector<float> x, y, z;
  std::vector<std::uint32_t> lane_of;  // where each point of the batch went
};

Chunks in_chunks(const PointBatch& batch) {
  Chunks c;
  c.lane_of.resize(batch.index.size());
  for (std::size_t b = 0; b < batch.bricks.size(); ++b) {
    const Coord o = batch.bricks.origins[b];
    const std::uint32_t end = batch.first_point[b + 1];
    for (std::uint32_t begin = batch.first_point[b]; begin < end; begin += kChunk) {
      c.chunks.push_back({{o.x, o.y, o.z}, batch.bricks.first[b], batch.bricks.first[b + 1], {}});
      for (std::uint32_t lane = 0; lane < kChunk; ++lane) {
        const std::uint32_t point = std::min(begin + lane, end - 1);
        if (begin + lane < end) c.lane_of[point] = static_cast<std::uint32_t>(c.x.size());
        c.x.push_back(batch.offset[point].x);
        c.y.push_back(batch.offset[point].y);
        c.z.push_back(batch.offset[point].z);
      }
    }
  }
  return c;
}

}  // namespace

struct Evaluator::Impl {
  Device::Engine& engine;
  int falloff;
  std::vector<DeviceKernel> host;  // outlives `kernels`, which may use it in place
  cl::Buffer kernels;

  /// Runs `work`, OpenCL's exceptions told in our words.
  template <class Work>
  auto run(const char* what, Work&& work) {
    try {
      return work();
    } catch (const cl::Error& error) {
      clFinish(engine.queue());  // nothing may still use the host's buffers
      throw Error(ErrorCode::device,
                  std::string(what) + " failed on '" + engine.info.name + "': " + error.what() +
                      " returned " + std::to_string(error.err()),
                  "Try a lower resolution or another device (`leafhull devices`).");
    }
  }

  /// A buffer over host values, in place where the device shares the host's memory. OpenCL has no
  /// empty buffers: no values give one byte.
  template <class T>
  cl::Buffer buffer(std::span<T> values, cl_mem_flags access) {
    if (values.empty()) return cl::Buffer(engine.context, access, 1);
    if (access == CL_MEM_WRITE_ONLY && !engine.shares_memory()) {
      return cl::Buffer(engine.context, access, values.size_bytes());
    }
    const cl_mem_flags place = engine.shares_memory() ? CL_MEM_USE_HOST_PTR : CL_MEM_COPY_HOST_PTR;
    return cl::Buffer(engine.context, access | place, values.size_bytes(),
                      const_cast<std::remove_const_t<T>*>(values.data()));
  }
  template <class T>
  cl::Buffer input(const std::vector<T>& values) {
    return buffer(std::span<const T>(values), CL_MEM_READ_ONLY);
  }

  /// Waits for the device and makes what it wrote visible in `values`.
  template <class T>
  void fetch(const cl::Buffer& buffer, std::span<T> values) {
    if (values.empty()) return;
    if (engine.shares_memory()) {
      void* mapped =
          engine.queue.enqueueMapBuffer(buffer, CL_TRUE, CL_MAP_READ, 0, values.size_bytes());
      engine.queue.enqueueUnmapMemObject(buffer, mapped);
      engine.queue.finish();
    } else {
      engine.queue.enqueueReadBuffer(buffer, CL_TRUE, 0, values.size_bytes(), values.data());
    }
  }

  void launch_points(const cl::Kernel& kernel, const Chunks& c) {
    if (c.chunks.empty()) return;
    const std::size_t per_chunk = engine.vector() ? 1 : kChunk;
    engine.queue.enqueueNDRangeKernel(
        kernel, cl::NullRange, cl::NDRange(c.chunks.size() * per_chunk), cl::NDRange(per_chunk));
  }
};

Evaluator::Evaluator(Device& device, std::span<const Kernel> kernels, const Lattice& lattice,
                     int falloff)
    : impl_(new Impl{device.engine(), falloff, {}, {}}) {
  impl_->host.reserve(kernels.size());
  for (const Kernel& kernel : kernels) {
    impl_->host.push_back(to_device(to_lattice(kernel, lattice)));
  }
  impl_->run("sending the kernels", [&] { impl_->kernels = impl_->input(impl_->host); });
}

Evaluator::~Evaluator() = default;
Evaluator::Evaluator(Evaluator&&) noexcept = default;

std::uint64_t Evaluator::sample(const BrickList& bricks, std::span<float> samples) {
  Impl& d = *impl_;
  std::vector<cl_int4> origins;
  for (const Coord o : bricks.origins) origins.push_back({{o.x, o.y, o.z, 0}});
  std::vector<std::uint32_t> pairs(bricks.size());

  d.run("evaluating the density", [&] {
    cl::Kernel kernel = d.engine.kernel("density_bricks", d.falloff);
    const cl::Buffer list = d.input(bricks.kernels);
    kernel.setArg(0, d.kernels);
    kernel.setArg(3, list);
    const std::size_t items = d.engine.vector() ? 1 : kWorkItems;
    for (std::size_t begin = 0; begin < bricks.size(); begin += kBricksPerLaunch) {
      const std::size_t count = std::min(kBricksPerLaunch, bricks.size() - begin);
      const auto out = samples.subspan(begin * kBrickSamples, count * kBrickSamples);
      const auto out_pairs = std::span(pairs).subspan(begin, count);
      const cl::Buffer origins_in =
          d.buffer(std::span<const cl_int4>(origins).subspan(begin, count), CL_MEM_READ_ONLY);
      const cl::Buffer first_in = d.buffer(
          std::span<const std::uint32_t>(bricks.first).subspan(begin, count + 1), CL_MEM_READ_ONLY);
      const cl::Buffer samples_out = d.buffer(out, CL_MEM_WRITE_ONLY);
      const cl::Buffer pairs_out = d.buffer(out_pairs, CL_MEM_WRITE_ONLY);
      kernel.setArg(1, origins_in);
      kernel.setArg(2, first_in);
      kernel.setArg(4, samples_out);
      kernel.setArg(5, pairs_out);
      d.engine.queue.enqueueNDRangeKernel(kernel, cl::NullRange, cl::NDRange(count * items),
                                          cl::NDRange(items));
      d.fetch(samples_out, out);
      d.fetch(pairs_out, out_pairs);
    }
  });
  std::uint64_t total = 0;
  for (const std::uint32_t p : pairs) total += p;
  return total;
}

std::vector<float> Evaluator::density(const PointBatch& batch) {
  Impl& d = *impl_;
  Chunks c = in_chunks(batch);
  std::vector<float> lanes(c.x.size());
  d.run("evaluating the density at points", [&] {
    cl::Kernel kernel = d.engine.kernel("density_points", d.falloff);
    const cl::Buffer in[] = {d.input(c.chunks), d.input(batch.bricks.kernels), d.input(c.x),
                             d.input(c.y), d.input(c.z)};
    const cl::Buffer out = d.buffer(std::span(lanes), CL_MEM_WRITE_ONLY);
    kernel.setArg(0, d.kernels);
    for (cl_uint i = 0; i < 5; ++i) kernel.setArg(1 + i, in[i]);
    kernel.setArg(6, out);
    d.launch_points(kernel, c);
    d.fetch(out, std::span(lanes));
  });
  std::vector<float> density(c.lane_of.size());
  for (std::size_t i = 0; i < density.size(); ++i) density[i] = lanes[c.lane_of[i]];
  return density;
}

Evaluator::Snapped Evaluator::snap(const PointBatch& batch, double threshold, int steps) {
  Impl& d = *impl_;
  Chunks c = in_chunks(batch);
  std::vector<float> nx(c.x.size()), ny(c.x.size()), nz(c.x.size());
  d.run("moving vertices onto the surface", [&] {
    cl::Kernel kernel = d.engine.kernel("snap_points", d.falloff);
    const cl::Buffer in[] = {d.input(c.chunks), d.input(batch.bricks.kernels)};
    std::vector<float>* const host[] = {&c.x, &c.y, &c.z, &nx, &ny, &nz};
    kernel.setArg(0, d.kernels);
    kernel.setArg(1, in[0]);
    kernel.setArg(2, in[1]);
    kernel.setArg(3, static_cast<cl_float>(threshold));
    kernel.setArg(4, static_cast<cl_int>(steps));
    cl::Buffer out[6];
    for (cl_uint i = 0; i < 6; ++i) {
      out[i] = d.buffer(std::span(*host[i]), CL_MEM_READ_WRITE);
      kernel.setArg(5 + i, out[i]);
    }
    d.launch_points(kernel, c);
    for (cl_uint i = 0; i < 6; ++i) d.fetch(out[i], std::span(*host[i]));
  });
  Snapped snapped;
  for (const std::uint32_t lane : c.lane_of) {
    snapped.offset.emplace_back(c.x[lane], c.y[lane], c.z[lane]);
    snapped.normal.emplace_back(nx[lane], ny[lane], nz[lane]);
  }
  return snapped;
}

void prepare(Device& device, int falloff) {
  Evaluator nothing(device, {}, Lattice{}, falloff);
  PointBatch point;  // in a brick that no kernel reaches
  point.bricks.add(Coord{}, {});
  point.first_point = {0, 1};
  point.index = {0};
  point.offset = {Vec3f{}};
  std::vector<float> samples(kBrickSamples);
  nothing.density(point);
  nothing.sample(point.bricks, samples);
  nothing.snap(point, 1, 1);
}

}  // namespace leafhull
