// SPDX-License-Identifier: Apache-2.0
#include <unistd.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <limits>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <system_error>
#include <utility>
#include <vector>

#include "leafhull/error.h"
#include "leafhull/output.h"
#include "output/destination.h"
#include "output/file_stream.h"
#include "output/mesh_vertex.h"
#include "output/transaction.h"
#include "output/vdb.h"
#include "output/writers.h"
#include "surface/density_grid.h"
#include "text/file_name.h"

namespace leafhull {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view kStandardOutput = "-";

struct ShapeFormat {
  std::string_view extension;
  void (*write)(const Shape& shape, std::ostream& stream);
};

void write_field(const Shape& shape, std::ostream& stream) {
  write_vdb(density_grid(*shape.field), stream);
}

template <void (*write)(const Mesh&, std::ostream&)>
void write_mesh(const Shape& shape, std::ostream& stream) {
  write(shape.mesh, stream);
}

constexpr std::array<ShapeFormat, 6> kShapeFormats{{{".glb", write_mesh<write_glb>},
                                                    {".gltf", write_mesh<write_gltf>},
                                                    {".obj", write_mesh<write_obj>},
                                                    {".ply", write_mesh<write_ply>},
                                                    {".stl", write_mesh<write_stl>},
                                                    {".vdb", write_field}}};

const ShapeFormat& format_of(const fs::path& file) {
  if (file == kStandardOutput) {
    throw Error(ErrorCode::usage, "shapes cannot be written to standard output",
                "Name a file, such as shape.glb.");
  }
  const std::string extension = lower_extension(file);
  std::string known;
  for (const ShapeFormat& format : kShapeFormats) {
    if (format.extension == extension) return format;
    known += (known.empty() ? "" : ", ") + std::string(format.extension);
  }
  throw Error(ErrorCode::usage,
              extension.empty() ? "the output " + file.string() + " has no extension"
                                : "unknown extension " + extension + " of " + file.string(),
              "Use one of " + known + ".");
}

void check_extension(const fs::path& file, std::string_view what, std::string_view extension) {
  if (lower_extension(file) == extension) return;
  throw Error(ErrorCode::usage,
              std::string(what) + " cannot be written to " + file.string() + ": not a " +
                  std::string(extension) + " file",
              "Name a " + std::string(extension) + " file.");
}

void refuse_input(const fs::path& file, const fs::path& destination, const fs::path& input) {
  std::error_code unreadable;
  if (destination != fs::weakly_canonical(input, unreadable)) return;
  throw Error(ErrorCode::usage, "the output " + file.string() + " is the input itself",
              "Name another file.");
}

bool to_standard_output(const std::optional<fs::path>& file) { return file == kStandardOutput; }

std::vector<fs::path> named_files(const OutputFiles& files) {
  std::vector<fs::path> named = files.shapes;
  if (files.kernels) named.push_back(*files.kernels);
  if (files.field) named.push_back(*files.field);
  if (files.report && !to_standard_output(files.report)) named.push_back(*files.report);
  return named;
}

/// Adds the time of writing all files except the report; the total stays last.
std::vector<StageTime> with_write(std::vector<StageTime> times, double seconds) {
  if (times.empty()) return times;
  times.back().seconds += seconds;
  times.insert(times.end() - 1, {"write", seconds});
  return times;
}

/// The distance between adjacent floats at the outermost vertex.
double float_step(const Mesh& mesh) {
  double farthest = 0;
  for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
    const Vec3d p = world_position(mesh, i);
    farthest = std::max({farthest, std::abs(p.x), std::abs(p.y), std::abs(p.z)});
  }
  const auto far = static_cast<float>(farthest);
  return std::nextafter(far, std::numeric_limits<float>::infinity()) - far;
}

void write_to_standard_output(const std::string& text) {
  FileStream stream(STDOUT_FILENO, "standard output");
  stream << text << std::flush;
}

}  // namespace

OutputPlan plan_outputs(OutputFiles files, const fs::path& input) {
  for (const fs::path& shape : files.shapes) format_of(shape);
  if (files.kernels) check_extension(*files.kernels, "the kernels", ".ply");
  if (files.field) check_extension(*files.field, "the field", ".vdb");
  if (files.report && !to_standard_output(files.report)) {
    check_extension(*files.report, "the report", ".json");
  }

  std::map<fs::path, fs::path> name_of_destination;
  for (const fs::path& file : named_files(files)) {
    const fs::path destination = resolve_destination(file);
    refuse_input(file, destination, input);
    const auto [first, is_new] = name_of_destination.emplace(destination, file);
    if (!is_new) {
      throw Error(
          ErrorCode::usage,
          "the outputs " + first->second.string() + " and " + file.string() + " are the same file",
          "Name each output differently.");
    }
  }
  return OutputPlan(std::move(files));
}

std::vector<std::string> rounding_warnings(const OutputPlan& plan, const Shape& shape) {
  const OutputFiles& files = plan.files();
  constexpr double kVisible = 0.05;  // of a voxel
  std::vector<fs::path> rounded;
  for (const fs::path& file : files.shapes) {
    if (lower_extension(file) == ".stl") rounded.push_back(file);
  }
  if (files.kernels) rounded.push_back(*files.kernels);
  const double step = float_step(shape.mesh), voxel = shape.report.voxel_size;
  std::vector<std::string> warnings;
  for (const fs::path& file : rounded) {
    if (step <= kVisible * voxel) break;
    std::array<char, 160> text;
    std::snprintf(text.data(), text.size(),
                  ": so far from the origin its floats are %.2g apart, and a voxel is %.2g; .glb, "
                  ".gltf, .obj, .ply and .vdb shapes keep their form",
                  step, voxel);
    warnings.push_back(file.string() + text.data());
  }
  return warnings;
}

void write_outputs(const OutputPlan& plan, const Shape& shape, const RunDescription& run) {
  const OutputFiles& files = plan.files();
  using Clock = std::chrono::steady_clock;
  const Clock::time_point begin = Clock::now();
  Transaction transaction;
  for (const fs::path& file : files.shapes) {
    const ShapeFormat& format = format_of(file);
    transaction.write(file, [&](std::ostream& stream) { format.write(shape, stream); });
  }
  if (files.kernels) {
    transaction.write(*files.kernels, [&](std::ostream& stream) {
      write_kernels(shape.kernels, shape.isotropic_density, stream);
    });
  }
  if (files.field) {
    transaction.write(*files.field, [&](std::ostream& stream) { write_field(shape, stream); });
  }
  if (files.report) {
    Report written = shape.report;
    const std::chrono::duration<double> seconds = Clock::now() - begin;
    written.seconds = with_write(std::move(written.seconds), seconds.count());
    const std::string report = report_json(written, run);
    if (to_standard_output(files.report)) {
      write_to_standard_output(report);
    } else {
      transaction.write(*files.report, [&](std::ostream& stream) { stream << report; });
    }
  }
  transaction.commit();
}

std::span<const OutputOptionRow> output_table() {
  using Row = OutputOptionRow;
  static const Row rows[] = {
      Row("Output", "output", &OutputFiles::shapes,
          "the shape, in the format of the extension; repeatable",
          {.range = ".glb .gltf .obj .ply .stl .vdb", .letter = 'o'}),
      Row("Output", "save-kernels", &OutputFiles::kernels,
          "a point per kernel with its axes, radii and density", {.range = ".ply"}),
      Row("Output", "save-field", &OutputFiles::field, "the sampled density as an OpenVDB grid",
          {.range = ".vdb"}),
      Row("Output", "report", &OutputFiles::report, "parameters, counts, metrics and times",
          {.range = ".json, or - for standard output"}),
  };
  return rows;
}

OutputFile::OutputFile(fs::path file, std::string_view extension,
                       const std::vector<fs::path>& inputs)
    : path_(std::move(file)) {
  check_extension(path_, "the result", extension);
  const fs::path destination = resolve_destination(path_);
  for (const fs::path& input : inputs) refuse_input(path_, destination, input);
}

void OutputFile::write(std::string_view bytes) const { write_file(path_, bytes); }

OutputFile OutputFolder::file(const fs::path& name, std::string_view extension,
                              const std::vector<fs::path>& inputs) const {
  const bool is_within = fs::proximate(name, path_).parent_path().empty();
  const bool is_named_well = lower_extension(name) == extension;
  if (is_within && is_named_well && !fs::exists(path_)) return OutputFile(name);
  return {name, extension, inputs};
}

}  // namespace leafhull
