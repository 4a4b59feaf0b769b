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
// Groups per launch, below the number at which PoCL compiles a kernel again.
constexpr std::size_t kGroupsPerLaunch = 1 << 15;

std::string closest_options(bool sampled, int lanes, int falloff) {
  return Device::Engine::density_options(falloff) + " -DLANES=" + std::to_string(lanes) +
         (sampled ? " -DSAMPLED" : "");
}

}  // namespace

struct RayCaster::Impl {
  /// The ball that a kernel reaches, voxels from the lattice's anchor, as the device reads it.
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

  /// Runs the kernel `name` on all rays, `per_item` per work-item. Its arguments are the grid,
  /// then `own`, then the number of rays, the rays and the results.
  template <class Result, class... Arguments>
  void cast(const char* name, int per_item, std::span<const VoxelRay> rays,
            std::span<Result> results, const Arguments&... own) {
    cl::Kernel kernel = engine.kernel(name, "rays", {std::string(kernel_source_rays)},
                                      closest_options(sampled, lanes, falloff));
    const auto quad = [](Coord c) { return cl_int4{{c.x, c.y, c.z, 0}}; };
    const std::size_t group = kGroup * static_cast<std::size_t>(per_item);
    for (std::size_t begin = 0; begin < rays.size(); begin += kGroupsPerLaunch * group) {
      const std::size_t count = std::min(kGroupsPerLaunch * group, rays.size() - begin);
      const auto out = results.subspan(begin, count);
      const cl::Buffer in = engine.buffer(rays.subspan(begin, count), CL_MEM_READ_ONLY);
      const cl::Buffer results_out = engine.buffer(out, CL_MEM_WRITE_ONLY);
      set_arguments(kernel, quad(grid.low), quad(grid.size), roots, children, samples, drawn, near,
                    own..., static_cast<cl_uint>(count), in, results_out);
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
    d.cast("rays_closest", d.lanes, rays, hits, d.kernels, d.balls, d.first, d.list, d.threshold);
  });
}

void RayCaster::blocked(std::span<const VoxelRay> rays, float soft, float reach,
                        std::span<float> blocked) {
  Impl& d = *impl_;
  d.engine.run("casting rays to the light",
               [&] { d.cast("rays_blocked", 1, rays, blocked, d.threshold, soft, reach); });
}

}  // namespace leafhull
