// The median of numbers.
#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

namespace paim {

// At least one value; of an even number of them the upper one of the two in the middle.
inline double median(std::vector<double> values) {
    const auto middle = values.begin() + static_cast<ptrdiff_t>(values.size() / 2);
    std::nth_element(values.begin(), middle, values.end());
    return *middle;
}

}  // namespace paim
