// Signs right behind a digit: walk2-001 and walk20001.
#pragma once

#include <string_view>
#include <vector>

#include "compressor/io/name_numbers.h"

namespace paim {

// Some exporters put the number of a frame right behind a name, and that may end in a digit. Then
// frame −1 of "walk2" is walk2-001, and its frame 1 is walk20001. A hyphen between digits is such a
// sign if other names go on behind the same text (walk2) with a number that has no hyphen, and
//   - numbers with hyphen have one width, which counts it, and begin with 0 (-001), and others have
//     this width (0001), or are too large for it; or
//   - all alike names without hyphen begin with such a text, and one of their numbers is 0, and
//     another one is there; or they are padded to the width of those with hyphen.
// Nowhere is there a sign in front of 0 (walk2-000).
// numbers  of each name; those with a sign get it, and numbers like 20001 become two
void find_signs_behind_digits(const std::vector<std::string_view>& names,
                              std::vector<std::vector<NameNumber>>& numbers);

}  // namespace paim
