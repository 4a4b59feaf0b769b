// SPDX-License-Identifier: Apache-2.0
#include "watercolour/passes.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <string>
#include <string_view>

#include "device/engine.h"

namespace leafhull {

extern const std::string_view kernel_source_watercolour;
extern const std::string_view kernel_source_watercolour_blur;
extern const std::string_view kernel_source_watercolour_noise;

namespace watercolour {
namespace {

constexpr int kPadding = 16;        // of rows and columns, as the kernels say
constexpr int kWorkItems = 16;      // of a group, in a pass over a plane
constexpr float kBlurReach = 2.6f;  // standard deviations

using Pool = std::vector<cl::Buffer>;

/// `n` rounded up to an odd multiple of kPadding: rows a power of two apart would compete for the
/// same few cache lines.
int padded(int n) { return ((n + kPadding - 1) / kPadding | 1) * kPadding; }

/// The weights of a Gaussian: that of the middle, then those of the neighbours on one side. Over
/// both sides they sum to 1.
std::vector<float> gaussian(float sigma) {
  const int reach = std::max(1, static_cast<int>(std::ceil(kBlurReach * sigma)));
  std::vector<double> weights;
  double sum = 0;
  for (int j = 0; j <= reach; ++j) {
    weights.push_back(std::exp(-0.5 * j * j / (static_cast<double>(sigma) * sigma)));
    sum += (j ? 2 : 1) * weights.back();
  }
  std::vector<float> result;
  for (const double weight : weights) result.push_back(static_cast<float>(weight / sum));
  return result;
}

cl_float4 as_float4(Vec3f v) { return {{v.x, v.y, v.z, 0}}; }

}  // namespace

struct PlaneMemory {
  PlaneMemory(cl::Buffer memory, std::shared_ptr<Pool> from)
      : buffer(std::move(memory)), pool(std::move(from)) {}
  PlaneMemory(const PlaneMemory&) = delete;
  PlaneMemory& operator=(const PlaneMemory&) = delete;
  ~PlaneMemory() { pool->push_back(std::move(buffer)); }  // there is room: see plane()

  cl::Buffer buffer;
  std::shared_ptr<Pool> pool;
};

struct Passes::Impl {
  Impl(Device::Engine& on, int of_width, int of_height)
      : engine(on),
        width(of_width),
        height(of_height),
        pitch(padded(of_width)),
        rows(padded(of_height)),
        lanes(on.vector() ? 16 : 1) {}

  Device::Engine& engine;
  int width, height, pitch, rows, lanes;
  std::size_t planes = 0;  ///< in use or free
  std::shared_ptr<Pool> free = std::make_shared<Pool>();
  std::map<std::string, cl::Kernel, std::less<>> kernels;
  std::map<float, cl::Buffer> weights;  ///< by standard deviation

  std::size_t values() const { return static_cast<std::size_t>(pitch) * rows; }

  Plane plane() {
    if (free->empty()) {
      ++planes;
      free->reserve(planes);
      free->emplace_back(engine.context, CL_MEM_READ_WRITE, values() * sizeof(float));
    }
    auto plane = std::make_shared<PlaneMemory>(free->back(), free);
    free->pop_back();
    return plane;
  }

  static const cl::Buffer& argument(const Plane& plane) { return plane->buffer; }
  template <class T>
  static const T& argument(const T& value) {
    return value;
  }

  template <class... Arguments>
  void launch(const char* name, const cl::NDRange& global, const cl::NDRange& local,
              const Arguments&... arguments) {
    cl::Kernel& kernel = kernels.at(name);
    set_arguments(kernel, argument(arguments)...);
    engine.queue.enqueueNDRangeKernel(kernel, cl::NullRange, global, local);
  }

  /// Runs a pass in which each pixel depends on no other.
  template <class... Arguments>
  void over_plane(const char* name, const Arguments&... arguments) {
    launch(name, cl::NDRange(values() / lanes), cl::NDRange(kWorkItems), arguments...);
  }

  /// The plane that such a pass makes.
  template <class... Arguments>
  Plane made(const char* name, const Arguments&... arguments) {
    Plane out = plane();
    over_plane(name, arguments..., out);
    return out;
  }

  /// Blurs the columns of `in` and transposes the result.
  void blur_turning(const Plane& in, int in_pitch, int in_rows, int rows_within,
                    const cl::Buffer& weights, int reach, const Plane& out) {
    const cl::NDRange group = lanes > 1 ? cl::NDRange(1, 1) : cl::NDRange(kPadding, kPadding);
    const std::size_t window = lanes > 1 ? lanes + 2 * reach : 1;
    launch("blur", cl::NDRange(in_pitch / lanes, in_rows / lanes), group, in, in_pitch, rows_within,
           weights, reach, cl::Local(window * lanes * sizeof(float)), out, in_rows);
  }
};

Passes::Passes(Device& device, int width, int height)
    : impl_(new Impl(device.engine(), width, height)) {
  Impl& d = *impl_;
  cl::Program::Sources sources;
  for (const std::string_view source : {kernel_source_watercolour, kernel_source_watercolour_blur,
                                        kernel_source_watercolour_noise}) {
    sources.emplace_back(source);
  }
  const cl::Program program =
      d.engine.build(sources, "-cl-std=CL1.2 -DLANES=" + std::to_string(d.lanes));
  for (const char* name :
       {"paper", "ground", "flow", "blur", "see", "pad", "darkness", "extend", "visibility", "mask",
        "layer", "darken_edges", "dilute", "granulate", "glaze", "wet", "bleed", "develop"}) {
    d.kernels.emplace(name, cl::Kernel(program, name));
  }
}

Passes::~Passes() = default;

std::size_t Passes::memory() const {
  return impl_->planes * plane_bytes(impl_->width, impl_->height);
}

std::size_t Passes::plane_bytes(int width, int height) {
  return sizeof(float) * padded(width) * padded(height);
}

Plane Passes::constant(float value) {
  Plane out = impl_->plane();
  impl_->engine.queue.enqueueFillBuffer(out->buffer, value, 0, impl_->values() * sizeof(float));
  return out;
}

Plane Passes::upload(std::span<const float> values) {
  Impl& d = *impl_;
  const cl::Buffer in(d.engine.context, CL_MEM_READ_ONLY | CL_MEM_COPY_HOST_PTR,
                      values.size_bytes(), const_cast<float*>(values.data()));
  Plane out = d.plane();
  d.launch("pad", cl::NDRange(d.pitch, d.rows), cl::NDRange(kPadding, 1), d.width, d.height,
           d.pitch, in, out);
  return out;
}

std::vector<float> Passes::download(const Plane& plane) {
  Impl& d = *impl_;
  std::vector<float> values(static_cast<std::size_t>(d.width) * d.height);
  const cl::array<cl::size_type, 3> start{0, 0, 0};
  const std::size_t row = d.width * sizeof(float);
  d.engine.queue.enqueueReadBufferRect(plane->buffer, CL_TRUE, start, start,
                                       {row, static_cast<std::size_t>(d.height), 1},
                                       d.pitch * sizeof(float), 0, row, 0, values.data());
  return values;
}

PaperPlanes Passes::paper(float period, int cells, std::uint32_t seed) {
  Impl& d = *impl_;
  PaperPlanes out{d.plane(), d.plane(), d.plane(), d.plane()};
  d.over_plane("paper", d.pitch, period, cells, seed, out.height, out.speckle, out.sway,
               out.relief);
  return out;
}

SeenPlanes Passes::see(const render::Buffers& buffers, float sky, float wrap) {
  Impl& d = *impl_;
  const cl::Buffer object = d.engine.input(buffers.object), normal = d.engine.input(buffers.normal),
                   position = d.engine.input(buffers.position),
                   depth = d.engine.input(buffers.depth), key = d.engine.input(buffers.key),
                   open = d.engine.input(buffers.open);
  SeenPlanes out{d.plane(), d.plane(), d.plane(), d.plane(), d.plane(), d.plane()};
  const Vec3f l = buffers.to_light;
  d.launch("see", cl::NDRange(d.pitch, d.rows), cl::NDRange(kPadding, 1), d.width, d.height,
           d.pitch, object, normal, position, depth, key, open, l.x, l.y, l.z, sky, wrap, out.seen,
           out.light, out.far, out.x, out.y, out.z);
  d.engine.queue.finish();  // the caller may now change its buffers
  return out;
}

Plane Passes::ground(float size, Vec2f foot, Vec2f reach, std::uint32_t seed) {
  return impl_->made("ground", impl_->pitch, size, foot.x, foot.y, reach.x, reach.y, seed);
}

FlowPlanes Passes::flow(const Plane& near, std::span<const Plane, 3> places, float eddies,
                        float leaves, std::uint32_t seed) {
  Impl& d = *impl_;
  FlowPlanes out{d.plane(), d.plane(), d.plane(), d.plane()};
  d.over_plane("flow", near, places[0], places[1], places[2], eddies, leaves, seed, out.turbulence,
               out.warmth, out.breaking, out.wetness);
  return out;
}

Plane Passes::blur(const Plane& in, float sigma) {
  if (!(sigma > 0.05f)) return in;
  Impl& d = *impl_;
  const std::vector<float> host = gaussian(sigma);
  auto weights = d.weights.find(sigma);
  if (weights == d.weights.end()) {
    const cl::Buffer buffer(d.engine.context, CL_MEM_READ_ONLY | CL_MEM_COPY_HOST_PTR,
                            host.size() * sizeof(float), const_cast<float*>(host.data()));
    weights = d.weights.emplace(sigma, buffer).first;
  }
  const int reach = static_cast<int>(host.size()) - 1;
  const Plane turned = d.plane();
  Plane out = d.plane();
  d.blur_turning(in, d.pitch, d.rows, d.height, weights->second, reach, turned);
  d.blur_turning(turned, d.rows, d.pitch, d.width, weights->second, reach, out);
  return out;
}

Plane Passes::darkness(const Plane& light, const Plane& seen) {
  return impl_->made("darkness", light, seen);
}

Plane Passes::extend(const Plane& seen, const Plane& value, const Plane& seen_near,
                     const Plane& value_near) {
  return impl_->made("extend", seen, value, seen_near, value_near);
}

Plane Passes::visibility(const Plane& far, const Plane& seen_around, const Plane& far_around,
                         float reach) {
  return impl_->made("visibility", far, seen_around, far_around, reach);
}

Plane Passes::mask(const Plane& plane, const Plane& by, float amount) {
  return impl_->made("mask", plane, by, amount);
}

Plane Passes::layer(const Plane& rho, const Plane& within, const PaperPlanes& paper,
                    const FlowPlanes& flow, const Edge& edge) {
  return impl_->made("layer", rho, within, paper.height, paper.sway, flow.breaking, flow.wetness,
                     edge.level, edge.softness, edge.lost, edge.dryness, edge.wobble,
                     edge.raggedness);
}

Plane Passes::darken_edges(const Plane& alpha, const Plane& around, float amount) {
  return impl_->made("darken_edges", alpha, around, amount);
}

void Passes::dilute(const Plane& density, const Plane& turbulence, const Plane& dark,
                    float turbulent, float backruns, float dilution) {
  impl_->over_plane("dilute", density, turbulence, dark, turbulent, backruns, dilution);
}

void Passes::granulate(const Plane& density, const PaperPlanes& paper, float granulation,
                       float dispersion) {
  impl_->over_plane("granulate", density, paper.height, paper.speckle, granulation, dispersion);
}

void Passes::glaze(const Plane& density, const Plane& warmth, const Pigments& pigments,
                   float warm_cool, std::span<const Plane, 3> absorbance) {
  impl_->over_plane("glaze", density, warmth, as_float4(pigments.cool), as_float4(pigments.warm),
                    warm_cool, absorbance[0], absorbance[1], absorbance[2]);
}

Plane Passes::wet(const Plane& wetness, const Plane& alpha, float amount) {
  return impl_->made("wet", wetness, alpha, amount);
}

void Passes::bleed(const Plane& absorbance, const Plane& around, const Plane& wet) {
  impl_->over_plane("bleed", absorbance, around, wet);
}

std::vector<std::uint8_t> Passes::develop(std::span<const Plane, 3> absorbance, const Plane& relief,
                                          Vec3f paper, float shading) {
  Impl& d = *impl_;
  std::vector<std::uint8_t> rgb(std::size_t{3} * d.width * d.height);
  const cl::Buffer out(d.engine.context, CL_MEM_WRITE_ONLY, rgb.size());
  d.launch("develop", cl::NDRange(d.width, d.height), cl::NullRange, d.width, d.pitch,
           absorbance[0], absorbance[1], absorbance[2], relief, as_float4(paper), shading, out);
  d.engine.queue.enqueueReadBuffer(out, CL_TRUE, 0, rgb.size(), rgb.data());
  return rgb;
}

}  // namespace watercolour
}  // namespace leafhull
