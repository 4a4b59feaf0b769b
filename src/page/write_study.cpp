// SPDX-License-Identifier: Apache-2.0
#include <filesystem>
#include <system_error>
#include <vector>

#include "leafhull/study.h"
#include "output/transaction.h"
#include "output/write_error.h"
#include "page/figures.h"
#include "page/study_json.h"
#include "page/study_page.h"

namespace leafhull {

namespace fs = std::filesystem;

void write_study(const Study& study, const OutputFolder& into) {
  const fs::path& folder = into.path();
  const std::vector<TreePlots> plots = draw_plots(study);
  std::error_code error;
  const bool is_new = fs::create_directories(folder, error);
  if (error) throw write_error(folder, error.value());
  try {
    Transaction transaction;
    transaction.write(folder / "report.html",
                      [&](std::ostream& stream) { write_report(study, plots, stream); });
    transaction.write(folder / "study.json",
                      [&](std::ostream& stream) { stream << study_json(study); });
    transaction.commit();
  } catch (...) {
    if (is_new) fs::remove(folder, error);
    throw;
  }
}

}  // namespace leafhull
