// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "leafhull/option_row.h"
#include "leafhull/shape.h"

namespace leafhull {

/// The files that one extraction writes.
struct OutputFiles {
  std::vector<std::filesystem::path> shapes = {};  ///< .glb .gltf .obj .ply .stl .vdb, by extension
  std::optional<std::filesystem::path> kernels = {};  ///< .ply
  std::optional<std::filesystem::path> field = {};    ///< .vdb
  std::optional<std::filesystem::path> report = {};   ///< .json; "-" is standard output
};

using OutputOptionRow =
    RowOver<OutputFiles, std::vector<std::filesystem::path>, std::optional<std::filesystem::path>>;
std::span<const OutputOptionRow> output_table();

/// What the report says beside the extraction itself.
struct RunDescription {
  std::string input;
  std::vector<std::string> command;
};

/// Output files that can be written: plan_outputs() has checked their names.
class OutputPlan {
 public:
  const OutputFiles& files() const { return files_; }

 private:
  friend OutputPlan plan_outputs(OutputFiles files, const std::filesystem::path& input);
  explicit OutputPlan(OutputFiles files) : files_(std::move(files)) {}

  OutputFiles files_;
};

/// Checks the names before any work is done.
/// @param input the file that the shape is made of.
/// @throws Error usage: an unknown extension, one file named twice, or the input itself;
///         output: a folder that does not exist or cannot be written to.
OutputPlan plan_outputs(OutputFiles files, const std::filesystem::path& input);

/// Checks a folder for results before any work is done. It need not exist.
/// @throws Error output: it could not be made or written to.
void check_output_folder(const std::filesystem::path& folder);

/// A warning where files of floats, .stl and the kernels, lose detail of a shape that lies far from
/// the origin.
std::vector<std::string> rounding_warnings(const OutputPlan& plan, const Shape& shape);

/// Writes everything under temporary names, then renames: all files or none. A report's seconds
/// gain `write`, the time that the other files took.
/// @throws Error output: which file and why.
void write_outputs(const OutputPlan& plan, const Shape& shape, const RunDescription& run);

/// As plan_outputs, for a single file that `write_file` will write.
void check_output(const std::filesystem::path& file, std::string_view extension,
                  const std::filesystem::path& input);

/// Writes the whole file or leaves it as it was.
/// @throws Error output: why.
void write_file(const std::filesystem::path& file, std::string_view bytes);

/// The report as one JSON object, schema "leafhull-report/1". SPEC: 7.
std::string report_json(const Report& report, const RunDescription& run);

/// Removes the temporary files of a write that is under way. Async-signal-safe.
void discard_unfinished_outputs() noexcept;

}  // namespace leafhull
