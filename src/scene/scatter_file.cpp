// SPDX-License-Identifier: Apache-2.0
#include "scene/scatter_file.h"

#include <cerrno>
#include <fstream>
#include <istream>
#include <map>
#include <system_error>
#include <unordered_map>

#include "leafhull/error.h"
#include "scene/scatter_row.h"
#include "scene/scene_builder.h"
#include "text/text.h"

namespace leafhull {
namespace {

namespace fs = std::filesystem;

[[noreturn]] void fail(const std::filesystem::path& file, std::error_code why) {
  throw Error(ErrorCode::input, file.string() + ": cannot be read: " + why.message(),
              "Give the path of a .csv or .jsonl file that you may read.");
}

std::ifstream open_text(const std::filesystem::path& file) {
  std::ifstream stream(file, std::ios::binary);
  if (!stream) fail(file, {errno, std::generic_category()});
  std::error_code unknown;
  if (std::filesystem::is_directory(file, unknown)) {
    fail(file, std::make_error_code(std::errc::is_a_directory));
  }
  return stream;
}

/// The lines of a text file that say something: blank ones and those that begin with # are passed
/// over, as are a byte order mark and carriage returns.
class Lines {
 public:
  /// @param file the name that messages use.
  Lines(std::istream& stream, const std::filesystem::path& file) : file_(file), stream_(stream) {}

  /// @throws Error input: the file cannot be read, or is UTF-16 text.
  bool next();
  std::string& text() { return text_; }
  std::size_t number() const { return number_; }  ///< from one

 private:
  std::filesystem::path file_;
  std::istream& stream_;
  std::string text_;
  std::size_t number_ = 0;
};

bool Lines::next() {
  while (std::getline(stream_, text_)) {
    ++number_;
    if (number_ == 1 && (text_.starts_with("\xFF\xFE") || text_.starts_with("\xFE\xFF"))) {
      throw Error(ErrorCode::input, file_.string() + ": is UTF-16 text", "Save it as UTF-8.");
    }
    if (number_ == 1 && text_.starts_with("\xEF\xBB\xBF")) text_.erase(0, 3);
    if (text_.ends_with('\r')) text_.pop_back();
    const std::size_t first = text_.find_first_not_of(" \t");
    if (first != std::string::npos && text_[first] != '#') return true;
  }
  if (stream_.bad()) fail(file_, {errno, std::generic_category()});
  return false;
}

/// The tree files that the lines name; two spellings of one file are one model.
class TreeFiles {
 public:
  explicit TreeFiles(const fs::path& scatter_file) : folder_(scatter_file.parent_path()) {}

  /// @throws BadRow: there is no such file.
  std::uint32_t number(const std::string& name, SceneBuilder& builder) {
    const auto known = by_name_.find(name);
    if (known != by_name_.end()) return known->second;
    return by_name_[name] = number_of_file(name, builder);
  }

 private:
  std::uint32_t number_of_file(const std::string& name, SceneBuilder& builder) {
    if (name.empty()) throw BadRow{"its model is empty", "Name a tree file."};
    const fs::path file = folder_ / name;
    std::error_code error;
    fs::path canonical = fs::canonical(file, error);
    if (!error && fs::is_directory(canonical))
      error = std::make_error_code(std::errc::is_a_directory);
    if (error) {
      throw BadRow{
          "the tree file " + printable(file.string(), 1000) + " is not there: " + error.message(),
          "Model names are paths from the folder of the scatter file."};
    }
    const auto [known, is_new] = by_file_.try_emplace(std::move(canonical));
    if (is_new) {
      SceneModel model;
      model.file = file;
      known->second = builder.add_model(std::move(model), printable(file.stem().string()));
    }
    return known->second;
  }

  fs::path folder_;
  std::unordered_map<std::string, std::uint32_t> by_name_;
  std::map<fs::path, std::uint32_t> by_file_;
};

template <class Rows>
Scene read_rows(std::istream& text, const fs::path& file, Rows rows) {
  SceneBuilder builder(file);
  TreeFiles tree_files(file);
  Lines lines(text, file);
  ScatterRow row;
  const auto model = [&] { return tree_files.number(row.model, builder); };
  const auto place = [&] { return "line " + std::to_string(lines.number()); };
  try {
    while (lines.next()) {
      if (rows.read(lines.text(), row)) builder.add(placed(row), model, place);
    }
  } catch (const BadRow& bad) {
    throw Error(ErrorCode::input, printable(file.string(), 1000) + ", " + place() + ": " + bad.what,
                bad.remedy);
  }
  if (const std::string names = rows.passed_over(); !names.empty()) {
    builder.warn("passed over: " + names);
  }
  return builder.finish();
}

}  // namespace

Scene read_csv_scene(const fs::path& file) {
  std::ifstream text = open_text(file);
  return read_csv_text(text, file);
}

Scene read_jsonl_scene(const fs::path& file) {
  std::ifstream text = open_text(file);
  return read_rows(text, file, JsonRows());
}

Scene read_csv_text(std::istream& text, const fs::path& file) {
  return read_rows(text, file, CsvRows());
}

}  // namespace leafhull
