// Half floats (IEEE 754 binary16) as files hold them.
#pragma once

#include <Eigen/Core>

#include <cstdint>

namespace paim {

// Rounds to nearest, ties to even. Values that round above 65504 become infinite.
inline uint16_t to_half(float value) {
    return Eigen::numext::bit_cast<uint16_t>(Eigen::half(value));
}

inline float from_half(uint16_t bits) {
    return static_cast<float>(Eigen::numext::bit_cast<Eigen::half>(bits));
}

}  // namespace paim
