// SPDX-License-Identifier: Apache-2.0
#include "device/ray_caster.h"

#include <algorithm>
#include <string>
#include <vector>

#include "device/engine.h"

namespace leafhull {

extern const std::string_view kernel_source_rays;

namespace {

constexpr std::size_t kGroup = 16;
// Groups of one launch, below the number from which PoCL compiles a kernel again.
constexpr std::size_t kGroupsPerLaunch = 1 << 15;

std::string closest_options(bool sampled, int lanes, int falloff) {
  return "-cl-std=CL1.2 -DFALLOFF=" + std::to_string(falloff) +
         " -DLANES=" + std::to_string(lanes) + (sampled ? " -DSAMPLED" : "");
}

/// What a kernel reaches, voxels from the lattice's anchor, as the device reads it.
struct alignas(16) Ball {
  Vec3f centre;
  float radius;
};

std::vector<Ball> balls_around(const KernelSet& kernels) {
  std::vector<Ball> balls;
  balls.reserve(kernels.kernels().size());
  for (std::size_t i = 0; i < kernels.kernels().size(); ++i) {
    const LatticeKernel& kernel = kernels.kernels()[i];
    balls.push_back({Vec3f(to_vec3d(kernel.cell) + Vec3d(kernel.offset)), kernels.radii()[i]});
  }
  return balls;
}

}  // namespace

struct RayCaster::Impl {
  Device::Engine& engine;
  const BrickGrid& grid;
  float threshold;
  int falloff;
  bool sampled;
  int lanes;  ///< rays that a work-item of rays_closest takes
  std::vector<Ball> all_balls;
  cl::Buffer roots, children, samples, drawn, near, kernels, balls, first, list;

  Impl(Device& device, const BrickGrid& brick_grid, double t, int k, bool from_samples)
      : engine(device.engine()),
        grid(brick_grid),
        threshold(static_cast<float>(t)),
        falloff(k),
        sampled(from_samples),
        lanes(engine.vector() && !from_samples ? 16 : 1) {
    engine.run("sending the field", [&] {
      roots = engine.input(grid.roots);
      children = engine.input(grid.children);
      samples = engine.input(grid.samples);
      drawn = engine.input(grid.drawn);
      near = engine.input(grid.near);
    });
  }

  cl::Kernel kernel(const char* name, int lanes_of_it) {
    cl::Kernel result = engine.kernel(name, "rays", {std::string(kernel_source_rays)},
                                      closest_options(sampled, lanes_of_it, falloff));
    const auto quad = [](Coord c) { return cl_int4{{c.x, c.y, c.z, 0}}; };
    result.setArg(0, quad(grid.low));
    result.setArg(1, quad(grid.size));
    result.setArg(2, roots);
    result.setArg(3, children);
    result.setArg(4, samples);
    result.setArg(5, drawn);
    result.setArg(6, near);
    return result;
  }

  /// Calls launch(begin, count, items) for pieces of `rays` rays, `per_item` to a work-item.
  template <class Launch>
  void in_launches(std::size_t rays, int per_item, Launch&& launch) {
    const std::size_t most = kGroupsPerLaunch * kGroup * static_cast<std::size_t>(per_item);
    for (std::size_t begin = 0; begin < rays; begin += most) {
      const std::size_t count = std::min(most, rays - begin);
      const std::size_t group_rays = kGroup * static_cast<std::size_t>(per_item);
      launch(begin, count, (count + group_rays - 1) / group_rays * kGroup);
    }
  }

  void enqueue(const cl::Kernel& kernel, std::size_t items) {
    engine.queue.enqueueNDRangeKernel(kernel, cl::NullRange, cl::NDRange(items),
                                      cl::NDRange(kGroup));
  }
};

RayCaster::RayCaster(Device& device, const BrickGrid& grid, double threshold,
                     const KernelSet& kernels, const BrickList& lists, int falloff)
    : impl_(std::make_unique<Impl>(device, grid, threshold, falloff, false)) {
  Impl& d = *impl_;
  d.engine.run("sending the kernels", [&] {
    d.kernels = d.engine.buffer(kernels.kernels(), CL_MEM_READ_ONLY);
    d.all_balls = balls_around(kernels);
    d.balls = d.engine.input(d.all_balls);
    d.first = d.engine.input(lists.first);
    d.list = d.engine.input(lists.kernels);
  });
}

RayCaster::RayCaster(Device& device, const BrickGrid& grid, double threshold)
    : impl_(std::make_unique<Impl>(device, grid, threshold, 2, true)) {
  Impl& d = *impl_;
  d.engine.run("sending the field", [&] {
    for (cl::Buffer* unused : {&d.kernels, &d.balls, &d.first, &d.list}) {
      *unused = cl::Buffer(d.engine.context, CL_MEM_READ_ONLY, 1);
    }
  });
}

RayCaster::~RayCaster() = default;
RayCaster::RayCaster(RayCaster&&) noexcept = default;

void RayCaster::closest(std::span<const VoxelRay> rays, std::span<VoxelHit> hits) {
  Impl& d = *impl_;
  d.engine.run("casting rays", [&] {
    cl::Kernel kernel = d.kernel("rays_closest", d.lanes);
    kernel.setArg(7, d.kernels);
    kernel.setArg(8, d.balls);
    kernel.setArg(9, d.first);
    kernel.setArg(10, d.list);
    kernel.setArg(11, d.threshold);
    d.in_launches(
        rays.size(), d.lanes, [&](std::size_t begin, std::size_t count, std::size_t items) {
          const auto out = hits.subspan(begin, count);
          const cl::Buffer in = d.engine.buffer(rays.subspan(begin, count), CL_MEM_READ_ONLY);
          const cl::Buffer hits_out = d.engine.buffer(out, CL_MEM_WRITE_ONLY);
          kernel.setArg(12, static_cast<cl_uint>(count));
          kernel.setArg(13, in);
          kernel.setArg(14, hits_out);
          d.enqueue(kernel, items);
          d.engine.fetch(hits_out, out);
        });
  });
}

void RayCaster::blocked(std::span<const VoxelRay> rays, float soft, float reach,
                        std::span<float> blocked) {
  Impl& d = *impl_;
  d.engine.run("casting rays to the light", [&] {
    cl::Kernel kernel = d.kernel("rays_blocked", d.lanes);
    kernel.setArg(7, d.threshold);
    kernel.setArg(8, soft);
    kernel.setArg(9, reach);
    d.in_launches(rays.size(), 1, [&](std::size_t begin, std::size_t count, std::size_t items) {
      const auto out = blocked.subspan(begin, count);
      const cl::Buffer in = d.engine.buffer(rays.subspan(begin, count), CL_MEM_READ_ONLY);
      const cl::Buffer blocked_out = d.engine.buffer(out, CL_MEM_WRITE_ONLY);
      kernel.setArg(10, static_cast<cl_uint>(count));
      kernel.setArg(11, in);
      kernel.setArg(12, blocked_out);
      d.enqueue(kernel, items);
      d.engine.fetch(blocked_out, out);
    });
  });
}

}  // namespace leafhull
