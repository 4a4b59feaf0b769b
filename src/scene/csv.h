// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace leafhull {

/// What separates the fields of a file with this first line: of comma, semicolon and tab that which
/// it has most of outside quotes, the semicolon before a comma that may be a decimal one.
char separator_of(std::string_view line);

/// The fields of a line, blanks around them left out. Within quotes a separator is text and "" is a
/// quote. They lie in `line`, which is rewritten for that.
/// Not a library's: Debian's fast-cpp-csv-parser knows its columns when it is compiled, and libcsv
/// numbers no lines.
/// @throws BadRow: a quote without an end, or text after it.
void split_csv(std::string& line, char separator, std::vector<std::string_view>& fields);

/// A field fit to be read by `split_csv` between commas.
std::string csv_field(std::string_view text);

}  // namespace leafhull
