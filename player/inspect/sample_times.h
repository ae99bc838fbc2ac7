// Poses that stand for a sequence.
#pragma once

#include <algorithm>
#include <cstdint>
#include <vector>

namespace paim::player {

// At most `most` poses, evenly spaced from the first to the last; all if there are no more. They are
// whole numbers.
// most     at least 2
// returns  ascending, at least one
inline std::vector<double> sample_times(uint32_t num_poses, uint32_t most) {
    const uint64_t count = std::clamp(num_poses, 1u, most);
    std::vector<double> times{0.0};
    for (uint64_t j = 1; j < count; ++j) {
        times.push_back(static_cast<double>(j * (num_poses - 1) / (count - 1)));
    }
    return times;
}

}  // namespace paim::player
