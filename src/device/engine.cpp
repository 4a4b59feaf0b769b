// SPDX-License-Identifier: Apache-2.0
#include "device/engine.h"

#include <string_view>

#include "density/lattice.h"
#include "leafhull/error.h"

namespace leafhull {

extern const std::string_view kernel_source_density_vector;
extern const std::string_view kernel_source_density_work_item;
extern const std::string_view kernel_source_points;

namespace {

/// One program with all kernels: in PoCL, the cost of a build hardly depends on its size.
cl::Program::Sources sources(bool vector) {
  const std::string_view density =
      vector ? kernel_source_density_vector : kernel_source_density_work_item;
  return {std::string(density), std::string(kernel_source_points)};
}

std::string build_options(const Device::Engine& engine, int falloff) {
  return Device::Engine::density_options(falloff) +
         " -DCHUNK_POINTS=" + std::to_string(engine.chunk_points()) +
         (engine.vector() ? "" : " -DLANES=1");
}

}  // namespace

std::string trimmed(std::string text) {
  while (!text.empty() && (text.back() == '\0' || text.back() == ' ')) text.pop_back();
  return text;
}

cl::Program Device::Engine::build(const cl::Program::Sources& sources,
                                  const std::string& options) const {
  cl::Program program;
  try {
    program = cl::Program(context, sources);
    program.build(device, options.c_str());
    return program;
  } catch (const cl::Error& error) {
    std::string log;
    if (program()) program.getBuildInfo(device, CL_PROGRAM_BUILD_LOG, &log);
    throw Error(ErrorCode::device,
                "the OpenCL kernels do not build on '" + info.name + "' (" + error.what() + ", " +
                    std::to_string(error.err()) + "):\n" + trimmed(log),
                "Choose another device with --device; if this is PoCL, check that its cache folder "
                "(POCL_CACHE_DIR) is writable.");
  }
}

cl::Kernel Device::Engine::kernel(const char* name, const std::string& program,
                                  const cl::Program::Sources& sources, const std::string& options) {
  const std::pair key(program, options);
  auto built = programs.find(key);
  if (built == programs.end()) {
    built = programs.emplace(key, build(sources, options)).first;
  }
  return cl::Kernel(built->second, name);
}

std::string Device::Engine::density_options(int falloff) {
  return "-cl-std=CL1.2 -DFALLOFF=" + std::to_string(falloff) +
         " -DBRICK_EDGE=" + std::to_string(kBrickEdge) +
         " -DROOT_EDGE=" + std::to_string(kRootEdge);
}

cl::Kernel Device::Engine::kernel(const char* name, int falloff) {
  return kernel(name, "density", sources(vector()), build_options(*this, falloff));
}

}  // namespace leafhull
