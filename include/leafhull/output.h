// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "leafhull/api.h"
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
LEAFHULL_API std::span<const OutputOptionRow> output_table();

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
LEAFHULL_API OutputPlan plan_outputs(OutputFiles files, const std::filesystem::path& input);

/// A warning where files of floats, .stl and the kernels, lose detail of a shape that lies far from
/// the origin.
LEAFHULL_API std::vector<std::string> rounding_warnings(const OutputPlan& plan, const Shape& shape);

/// Writes everything under temporary names, then renames: all files or none. A report's seconds
/// gain `write`, the time that the other files took.
/// @throws Error output: which file and why.
LEAFHULL_API void write_outputs(const OutputPlan& plan, const Shape& shape,
                                const RunDescription& run);

/// A single file that can be written.
class OutputFile {
 public:
  /// Checks the name before any work is done.
  /// @param inputs the files that it is made of.
  /// @throws Error usage: an extension other than `extension`, or one of the inputs itself;
  ///         output: a folder that does not exist or cannot be written to.
  LEAFHULL_API OutputFile(std::filesystem::path file, std::string_view extension,
                          const std::vector<std::filesystem::path>& inputs);

  const std::filesystem::path& path() const { return path_; }
  /// Writes the whole file or leaves it as it was. Makes the OutputFolder that it is from.
  /// @throws Error output: why.
  LEAFHULL_API void write(std::string_view bytes) const;

 private:
  friend class OutputFolder;
  OutputFile(std::filesystem::path file, std::filesystem::path folder)
      : path_(std::move(file)), folder_(std::move(folder)) {}

  std::filesystem::path path_;
  std::filesystem::path folder_;  ///< made where it is missing; empty: it was there
};

/// A folder that results can be written into; it need not exist.
class OutputFolder {
 public:
  /// Checks the folder before any work is done.
  /// @throws Error output: it could not be made or written to.
  LEAFHULL_API explicit OutputFolder(std::filesystem::path folder);

  const std::filesystem::path& path() const { return path_; }
  /// A file, which may lie in this folder before that is made.
  /// @param name relative to the working folder, not to this one.
  /// @throws Error as OutputFile does.
  LEAFHULL_API OutputFile file(const std::filesystem::path& name, std::string_view extension,
                               const std::vector<std::filesystem::path>& inputs) const;

 private:
  std::filesystem::path path_;
};

/// The report as one JSON object, schema "leafhull-report/1". SPEC: 7.
LEAFHULL_API std::string report_json(const Report& report, const RunDescription& run);

/// Removes the temporary files of a write that is under way. Async-signal-safe.
LEAFHULL_API void discard_unfinished_outputs() noexcept;

}  // namespace leafhull
