// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>

namespace leafhull {

/// What a thing of a tree file can be.
enum class Growth { unknown, leaves, undergrowth, wood, other };

/// What a name says: 1 leaves, -1 something else, 0 nothing; between where it says both or only
/// hints at it.
struct NameSign {
  double weight = 0;
  Growth growth = Growth::unknown;  ///< of the last word that says something
  std::string word;                 ///< as the name has it, in lower case and without accents
};

/// Looks for words for leaves, wood, ground and the like in some twenty languages; the last
/// one in the name decides, as in BranchLeaves and LeafStem. Words are known with and without
/// accents, in CamelCase and in compounds such as Laubblatt.
NameSign read_name(std::string_view name);

/// In lower case, accents taken off, words in CamelCase and digits set apart by blanks; what is not
/// UTF-8 is kept as it is.
std::string folded(std::string_view name);

}  // namespace leafhull
