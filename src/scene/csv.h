// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace leafhull {

/// The separator of a file with this first line: the comma, semicolon or tab that occurs most
/// outside quotes; on a tie the semicolon, since a comma may be a decimal one.
char separator_of(std::string_view line);

/// The fields of a line, without blanks around them. Within quotes a separator is text and "" is a
/// quote. The fields point into `line`, which is rewritten.
/// No library fits: Debian's fast-cpp-csv-parser knows its columns when it is compiled, and libcsv
/// numbers no lines.
/// @throws BadRow: a quote without an end, or text after it.
void split_csv(std::string& line, char separator, std::vector<std::string_view>& fields);

/// The text as a field that `split_csv` can read between commas.
std::string csv_field(std::string_view text);

}  // namespace leafhull
