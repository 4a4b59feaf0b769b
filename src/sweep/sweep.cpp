// SPDX-License-Identifier: Apache-2.0
// A sweep: its folder, what is done and what remains.
#include "leafhull/sweep.h"

#include <algorithm>
#include <chrono>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "leafhull/error.h"
#include "output/destination.h"
#include "output/report.h"
#include "pipeline/series.h"
#include "runs/read_file.h"
#include "runs/run_folder.h"
#include "sweep/journal.h"
#include "sweep/plots.h"
#include "sweep/sheets.h"
#include "sweep/sweep_plan.h"
#include "sweep/tables.h"

namespace leafhull {
namespace {

namespace fs = std::filesystem;

constexpr int kPictureWidth = 256, kPictureHeight = 256;

/// The layout of a sweep's folder.
class Files : public RunFolder {
 public:
  explicit Files(const fs::path& folder) : RunFolder(folder, "sweep"), folder_(folder) {}

  const fs::path& folder() const { return folder_; }
  fs::path journal() const { return folder_ / "sweep.jsonl"; }
  fs::path csv() const { return folder_ / "sweep.csv"; }
  fs::path json() const { return folder_ / "sweep.json"; }
  fs::path pictures() const { return folder_ / "pictures"; }

  /// Puts a result on the disk. A symbolic link stays, and its target is replaced.
  void put(const fs::path& file, std::string_view bytes) {
    write(resolve_destination(file), bytes);
    sync();
  }
  void put(const fs::path& file, const Picture& picture) {
    const std::vector<std::uint8_t> png = encode_png(picture);
    put(file, {reinterpret_cast<const char*>(png.data()), png.size()});
  }

 private:
  fs::path folder_;
};

Picture read_picture(const fs::path& file) {
  const std::string bytes = content_of(file);
  return decode_png({reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size()});
}

bool is_picture(const fs::path& file) {
  try {
    return !read_picture(file).rgb.empty();
  } catch (const Error&) {
    return false;
  }
}

/// Every file that the sweep will have written at its end, but for the journal.
std::vector<fs::path> results(const Files& files, const SweepPlan& plan) {
  std::vector<fs::path> all = {files.csv(), files.json()};
  for (const std::string& plot : plot_files(plan)) all.push_back(files.folder() / plot);
  for (const Sheet& sheet : sheets(plan)) all.push_back(files.folder() / sheet.file);
  for (std::size_t i = 0; i < plan.combinations().size(); ++i) {
    all.push_back(files.pictures() / picture_name(plan, i));
  }
  return all;
}

/// Checks that, without a journal, no file has a sweep's names: it would be somebody else's.
void check_nothing_is_lost(const Files& files, const SweepPlan& plan) {
  for (const fs::path& file : results(files, plan)) {
    if (!fs::exists(fs::symlink_status(file))) continue;
    throw Error(ErrorCode::usage, file.string() + " already exists and is not from this sweep",
                "Name another folder, or give --restart to replace it.");
  }
}

/// Removes what the sweep of `journal` has written, and nothing else.
void remove_results(const Files& files, const Journal& journal) {
  if (journal.header().is_null()) return;
  for (const Json& result : journal.header().value("results", Json::array())) {
    remove_path(files.folder() / fs::path(result.get<std::string>()).filename());
  }
  for (const auto& [combination, row] : journal.rows()) {
    remove_path(files.pictures() / fs::path(row["picture"].get<std::string>()).filename());
  }
}

Json header_of(const Json& identity, const Files& files, const SweepPlan& plan) {
  Json header = identity;
  for (const fs::path& result : results(files, plan)) {
    if (result.parent_path() == files.folder()) {
      header["results"].push_back(result.filename().string());
    }
  }
  return header;
}

/// The combinations that are still to do: not in the journal, failed, or without their pictures.
std::vector<std::size_t> remaining(const Files& files, const SweepPlan& plan,
                                   const Journal& journal) {
  const auto is_done = [&](std::size_t i) {
    const auto row = journal.rows().find(i);
    return row != journal.rows().end() && failure_of(row->second).empty() &&
           is_picture(files.pictures() / picture_name(plan, i));
  };
  std::vector<std::size_t> todo;
  for (std::size_t i = 0; i < plan.combinations().size(); ++i) {
    if (!is_done(i)) todo.push_back(i);
  }
  return todo;
}

double largest_radius(const LeafSet& leaves, const SweepPlan& plan) {
  double radius = 0;
  for (const Options& options : plan.combinations()) {
    radius = std::max(radius, radius_max_in_model_units(leaves, options));
  }
  return radius;
}

void add_times(std::vector<StageTime>& sums, const std::vector<StageTime>& times) {
  if (sums.empty()) sums.push_back({"total", 0});
  for (const StageTime& time : times) {
    auto sum = std::find_if(sums.begin(), sums.end(),
                            [&](const auto& other) { return other.stage == time.stage; });
    if (sum == sums.end()) sum = sums.insert(sums.end() - 1, {time.stage, 0});
    sum->seconds += time.seconds;
  }
}

Advance counted(std::string_view stage, std::size_t finished, const SweepPlan& plan) {
  const std::size_t all = plan.combinations().size();
  return {.stage = stage,
          .done = static_cast<double>(finished) / static_cast<double>(all),
          .finished = finished,
          .all = all};
}

/// Extracts what remains; each combination's picture is written before its line of the journal.
std::vector<StageTime> extract_remaining(const LeafSet& leaves, const SweepPlan& plan,
                                         Device& device, Files& files, Journal& journal,
                                         const Progress& progress) {
  using Clock = std::chrono::steady_clock;
  const std::vector<std::size_t> todo = remaining(files, plan, journal);
  std::vector<Options> options;
  for (const std::size_t i : todo) options.push_back(plan.combinations()[i]);
  const Frame frame = frame_of(leaves, largest_radius(leaves, plan));
  std::vector<StageTime> sums;
  std::size_t done = plan.combinations().size() - todo.size();
  const auto tell = [&](std::string_view stage) {
    if (progress) progress(counted(stage, done, plan));
  };
  tell("start");
  const SeriesVisitor visit = [&](std::size_t index, SeriesEntry&& entry) {
    tell("picture");
    const Clock::time_point begin = Clock::now();
    const std::string name = picture_name(plan, todo[index]);
    files.put(files.pictures() / name,
              draw_shape(entry.mesh, frame, kPictureWidth, kPictureHeight));
    const std::chrono::duration<double> seconds = Clock::now() - begin;
    add_stage(entry.report.seconds, "picture", seconds.count());
    add_times(sums, entry.report.seconds);
    journal.append(row_of(todo[index], "pictures/" + name, entry));
    ++done;
    tell("picture");
    return true;
  };
  extract_series(leaves, options, device, visit, [&](const Advance& now) { tell(now.stage); });
  return sums;
}

void write_tables(Files& files, const SweepPlan& plan, const Journal& journal,
                  const RunDescription& run) {
  files.put(files.csv(), csv(plan, journal.rows()));
  files.put(files.json(), sweep_json(journal.header(), journal.rows(), run));
}

void write_plots(Files& files, const SweepPlan& plan, const Journal& journal,
                 const std::string& tree) {
  for (const Plot& plot : plots(plan, journal.rows(), tree)) {
    files.put(files.folder() / plot.file, svg(plot.chart));
  }
}

void write_sheets(Files& files, const SweepPlan& plan, const Journal& journal,
                  const std::string& tree) {
  const std::vector<Sheet> pages = sheets(plan);
  for (std::size_t page = 0; page < pages.size(); ++page) {
    const Sheet& sheet = pages[page];
    std::vector<LabelledPicture> pictures;
    for (std::size_t i = sheet.begin; i < sheet.end; ++i) {
      std::vector<std::string> lines = labels(plan, i);
      const Json& row = journal.rows().at(i);
      if (row["empty"].get<bool>())
        lines.emplace_back(failure_of(row).empty() ? "no surface" : "failed");
      pictures.push_back({read_picture(files.pictures() / picture_name(plan, i)), lines});
    }
    std::string title = sheet_title(plan, tree);
    if (pages.size() > 1) {
      title += " (" + std::to_string(page + 1) + " of " + std::to_string(pages.size()) + ")";
    }
    files.put(files.folder() / sheet.file, contact_sheet(title, pictures, sheet_columns(plan)));
  }
}

}  // namespace

SweepSummary run_sweep(const LeafSet& leaves, const SweepPlan& plan, Device& device,
                       const SweepFolder& folder, const RunDescription& run,
                       const Progress& progress) {
  Files files(folder.folder.path());
  const Json header = header_of(identity(leaves, plan, device.info()), files, plan);
  check_series(leaves, plan.combinations());
  files.make_folder(files.folder());
  if (!folder.restart && !fs::exists(files.journal())) check_nothing_is_lost(files, plan);
  Journal journal(files.journal());
  if (folder.restart) remove_results(files, journal);
  if (!folder.restart && !journal.is_readable()) {
    throw Error(ErrorCode::usage,
                files.journal().string() + " is damaged or from another version of leafhull",
                "Name another folder, or give --restart to replace that sweep.");
  }
  if (folder.restart || journal.rows().empty()) journal.begin(header);
  check_same_sweep(journal.header(), header, files.folder());
  files.make_folder(files.pictures());
  files.remove_unfinished();

  SweepSummary summary;
  summary.combinations = plan.combinations().size();
  summary.resumed = summary.combinations - remaining(files, plan, journal).size();
  const bool with_plots = !plot_files(plan).empty() && can_draw_charts();
  if (!with_plots && !plot_files(plan).empty()) {
    summary.warnings.emplace_back("no plots are drawn: gnuplot is missing (gnuplot-nox in Debian)");
  }
  summary.seconds = extract_remaining(leaves, plan, device, files, journal, progress);
  for (const auto& [combination, row] : journal.rows()) {
    const std::string failure = failure_of(row);
    summary.empty += row["empty"].get<bool>() && failure.empty();
    if (!failure.empty() && summary.failed++ == 0) summary.warnings.push_back(failure);
  }

  if (progress) progress(counted("write", summary.combinations, plan));
  write_tables(files, plan, journal, run);
  const std::string tree = fs::path(run.input).filename().string();
  write_sheets(files, plan, journal, tree);
  if (with_plots) write_plots(files, plan, journal, tree);
  return summary;
}

}  // namespace leafhull
