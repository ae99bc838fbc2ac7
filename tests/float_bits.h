// Floats compared bit for bit.
#pragma once

#include <bit>
#include <cstdint>
#include <span>
#include <vector>

namespace paim {

inline std::vector<uint32_t> bits(std::span<const float> values) {
    std::vector<uint32_t> result;
    for (const float value : values) result.push_back(std::bit_cast<uint32_t>(value));
    return result;
}

}  // namespace paim
