// How many values a search looks at, which decides how much memory it takes.
#pragma once

#include <cstddef>

namespace paim {

// Values that steps are tried on, up to twice as many: few enough that a step is found in a moment,
// enough that it is the right one.
constexpr size_t kSampledValues = 1'000'000;

}  // namespace paim
