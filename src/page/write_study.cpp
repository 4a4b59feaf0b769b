// SPDX-License-Identifier: Apache-2.0
#include <filesystem>
#include <system_error>
#include <vector>

#include "leafhull/study.h"
#include "output/transaction.h"
#include "output/write_error.h"
#include "page/figures.h"
#include "page/report.h"
#include "page/study_json.h"

namespace leafhull {

namespace fs = std::filesystem;

void write_study(const Study& study, const fs::path& folder) {
  const std::vector<TreePlots> plots = draw_plots(study);
  std::error_code error;
  fs::create_directory(folder, error);
  if (error) throw write_error(folder, error.value());
  Transaction transaction;
  const auto write = [&](const fs::path& name, const auto& writer) {
    transaction.write(folder / name, writer);
  };
  write("report.html", [&](std::ostream& stream) { write_report(study, plots, stream); });
  write("study.json", [&](std::ostream& stream) { stream << study_json(study); });
  for (const TreePlots& tree : plots) {
    for (const auto& plots_of_tree : {tree.first, tree.all}) {
      for (const Plot& plot : plots_of_tree) {
        write(plot.file_name, [&](std::ostream& stream) { stream << plot.svg; });
      }
    }
  }
  transaction.commit();
}

}  // namespace leafhull
