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

}  // namespace

struct RayCaster::Impl {
  /// What a kernel reaches, voxels from the lattice's anchor, as the device reads it.
  struct alignas(16) Ball {
    Vec3f centre;
    float radius;
  };

  static std::vector<Ball> balls_around(const KernelSet& kernels) {
    std::vector<Ball> balls;
    balls.reserve(kernels.kernels().size());
    for (std::size_t i = 0; i < kernels.kernels().size(); ++i) {
      const LatticeKernel& kernel = kernels.kernels()[i];
      balls.push_back({Vec3f(to_vec3d(kernel.cell) + Vec3d(kernel.offset)), kernels.radii()[i]});
    }
    return balls;
  }

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

  /// Runs `kernel`, whose arguments from `next` on are the number of rays, the rays and the
  /// results, on all of them, `per_item` to a work-item.
  template <class Result>
  void cast(cl::Kernel& kernel, cl_uint next, int per_item, std::span<const VoxelRay> rays,
            std::span<Result> results) {
    const std::size_t group = kGroup * static_cast<std::size_t>(per_item);
    for (std::size_t begin = 0; begin < rays.size(); begin += kGroupsPerLaunch * group) {
      const std::size_t count = std::min(kGroupsPerLaunch * group, rays.size() - begin);
      const auto out = results.subspan(begin, count);
      const cl::Buffer in = engine.buffer(rays.subspan(begin, count), CL_MEM_READ_ONLY);
      const cl::Buffer results_out = engine.buffer(out, CL_MEM_WRITE_ONLY);
      kernel.setArg(next, static_cast<cl_uint>(count));
      kernel.setArg(next + 1, in);
      kernel.setArg(next + 2, results_out);
      engine.queue.enqueueNDRangeKernel(kernel, cl::NullRange,
                                        cl::NDRange((count + group - 1) / group * kGroup),
                                        cl::NDRange(kGroup));
      engine.fetch(results_out, out);
    }
  }
};

RayCaster::RayCaster(Device& device, const BrickGrid& grid, double threshold,
                     const KernelSet& kernels, const BrickList& lists, int falloff)
    : impl_(std::make_unique<Impl>(device, grid, threshold, falloff, false)) {
  Impl& d = *impl_;
  d.engine.run("sending the kernels", [&] {
    d.kernels = d.engine.buffer(kernels.kernels(), CL_MEM_READ_ONLY);
    d.all_balls = Impl::balls_around(kernels);
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
    d.cast(kernel, 12, d.lanes, rays, hits);
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
    d.cast(kernel, 10, 1, rays, blocked);
  });
}

}  // namespace leafhull
