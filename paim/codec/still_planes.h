// Values of what does not move: floats, or integers that count steps.
#pragma once

#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "paim/base/check.h"
#include "paim/codec/stored_values.h"

namespace paim {

struct StillPlanes {
    StoredValues values;       // [planes][N], in steps
    std::vector<float> steps;  // [planes], of integers; floats: empty, 1 each

    StillPlanes() = default;
    StillPlanes(std::vector<float> floats) : values(std::move(floats)) {}
    StillPlanes(StoredValues integers, std::vector<float> their_steps)
        : values(std::move(integers)), steps(std::move(their_steps)) {}

    // [planes][N]
    std::vector<float> floats() const {
        if (steps.empty()) return values.floats();
        PAIM_CHECK_EQ(values.size() % steps.size(), 0u);
        const size_t num_points = values.size() / steps.size();
        std::vector<float> result(values.size());
        values.for_each(0, values.size(),
                        [&](size_t j, float value) { result[j] = steps[j / num_points] * value; });
        return result;
    }

    bool operator==(const StillPlanes&) const = default;
};

}  // namespace paim
