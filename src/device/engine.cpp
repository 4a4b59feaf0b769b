// SPDX-License-Identifier: Apache-2.0
#include "device/engine.h"

#include "leafhull/error.h"

namespace leafhull {

extern const std::string_view kernel_source_density_vector;
extern const std::string_view kernel_source_density_work_item;
extern const std::string_view kernel_source_points;

namespace {

std::string_view trimmed(std::string_view text) {
  const std::size_t last = text.find_last_not_of(std::string_view(" \n\0", 3));
  return text.substr(0, last + 1);
}

/// One program of all kernels: what a build costs PoCL hardly depends on what is in it.
cl::Program::Sources sources(bool vector) {
  const std::string_view density =
      vector ? kernel_source_density_vector : kernel_source_density_work_item;
  return {std::string(density), std::string(kernel_source_points)};
}

std::string build_options(bool vector, int falloff) {
  return "-cl-std=CL1.2 -DFALLOFF=" + std::to_string(falloff) +
         (vector ? " -DLANES=16" : " -DLANES=1");
}

}  // namespace

cl::Kernel Device::Engine::kernel(const char* name, int falloff) {
  auto [entry, added] = programs.try_emplace(falloff);
  cl::Program& program = entry->second;
  try {
    if (added) {
      program = cl::Program(context, sources(vector()));
      program.build(device, build_options(vector(), falloff).c_str());
    }
    return cl::Kernel(program, name);
  } catch (const cl::Error& error) {
    std::string log;
    if (program()) program.getBuildInfo(device, CL_PROGRAM_BUILD_LOG, &log);
    programs.erase(entry);
    throw Error(ErrorCode::device,
                "the OpenCL kernel " + std::string(name) + " does not build on '" + info.name +
                    "' (" + error.what() + ", " + std::to_string(error.err()) + "):\n" +
                    std::string(trimmed(log)),
                "Choose another device with --device; if this is PoCL, see that its cache folder "
                "(POCL_CACHE_DIR) can be written to.");
  }
}

}  // namespace leafhull
