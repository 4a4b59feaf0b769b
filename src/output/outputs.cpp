// SPDX-License-Identifier: Apache-2.0
#include <unistd.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <limits>
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
#include "output/report.h"
#include "output/transaction.h"
#include "output/vdb.h"
#include "output/write_error.h"
#include "output/writers.h"
#include "surface/density_grid.h"
#include "text/choice.h"
#include "text/file_name.h"
#include "text/numbers.h"

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
  const auto* format = std::ranges::find(kShapeFormats, extension, &ShapeFormat::extension);
  if (format != kShapeFormats.end()) return *format;
  refuse_extension(file, extension,
                   "Use one of " + joined(kShapeFormats, ", ", &ShapeFormat::extension) + ".");
}

void check_extension(const fs::path& file, std::string_view what, std::string_view extension) {
  if (lower_extension(file) == extension) return;
  throw Error(ErrorCode::usage,
              std::string(what) + " cannot be written to " + file.string() + ": not a " +
                  std::string(extension) + " file",
              "Name a " + std::string(extension) + " file.");
}

bool to_standard_output(const std::optional<fs::path>& file) { return file == kStandardOutput; }

std::vector<fs::path> named_files(const OutputFiles& files) {
  std::vector<fs::path> named = files.shapes;
  if (files.kernels) named.push_back(*files.kernels);
  if (files.field) named.push_back(*files.field);
  if (files.report && !to_standard_output(files.report)) named.push_back(*files.report);
  return named;
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

  Destinations destinations({input});
  for (const fs::path& file : named_files(files)) destinations.add(file);
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
    warnings.push_back(file.string() + ": so far from the origin its floats are " +
                       significant(step, 2) + " apart, and a voxel is " + significant(voxel, 2) +
                       "; .glb, .gltf, .obj, .ply and .vdb shapes keep their form");
  }
  return warnings;
}

void write_outputs(const OutputPlan& plan, const Shape& shape, const RunDescription& run) {
  const OutputFiles& files = plan.files();
  if ((files.report || files.kernels) && shape.report.detail != Detail::report) {
    throw Error(ErrorCode::usage, "a shape without the density at its leaves has no report",
                "Extract it with Detail::report.");
  }
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
    if (!written.seconds.empty()) add_stage(written.seconds, "write", seconds.count());
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
  Destinations(inputs).add(path_);
}

void OutputFile::write(std::string_view bytes) const {
  std::error_code error;
  if (!folder_.empty()) fs::create_directories(folder_, error);
  if (error) throw write_error(path_, error.value());
  write_file(path_, bytes);
}

OutputFile OutputFolder::file(const fs::path& name, std::string_view extension,
                              const std::vector<fs::path>& inputs) const {
  std::error_code error;
  const bool is_within = fs::proximate(name, path_, error).parent_path().empty();
  if (error) throw write_error(name, error.value());
  const bool is_there = fs::exists(path_, error);
  if (error) throw write_error(path_, error.value());
  const bool is_named_well = lower_extension(name) == extension;
  if (is_within && is_named_well && !is_there) return {name, path_};
  return {name, extension, inputs};
}

}  // namespace leafhull
