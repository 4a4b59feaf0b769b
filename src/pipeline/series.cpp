// SPDX-License-Identifier: Apache-2.0
#include "leafhull/series.h"

#include <utility>

#include "leafhull/error.h"

namespace leafhull {

void extract_series(const LeafSet& leaves, std::span<const Options> options, Device& device,
                    const SeriesVisitor& visit, const Progress& progress) {
  for (const Options& entry : options) (void)resolve(entry);
  for (std::size_t i = 0; i < options.size(); ++i) {
    SeriesEntry entry;
    try {
      Shape shape = extract(leaves, options[i], device, progress);
      entry = {std::move(shape.report), std::move(shape.mesh)};
    } catch (const Error& error) {
      if (error.code() != ErrorCode::empty) throw;
      entry.report.options = resolve(options[i]);
    }
    if (!visit(i, std::move(entry))) return;
  }
}

}  // namespace leafhull
