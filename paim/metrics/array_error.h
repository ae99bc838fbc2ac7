// How far decoded values are from the baked ones: worst value and where, RMS, relative.
#pragma once

#include <cstdint>
#include <span>

namespace paim {

// Sums, so that several poses make one figure.
struct ArrayError {
    double squared_sum = 0.0;            // Σ (a − b)²
    double reference_squared_sum = 0.0;  // Σ b²
    uint64_t num_values = 0;
    double worst = 0.0;  // largest |a − b|
    uint64_t worst_index = 0;
    uint32_t worst_pose = 0;

    double rms() const;
    double relative() const;  // ‖a − b‖ / ‖b‖; 0 where both are 0

    // Adds the values of one pose; the spans have the same length (checked).
    void add(std::span<const float> values, std::span<const float> reference, uint32_t pose);
};

// The same for distances between points: planes x, y, z of V values each.
struct DistanceError {
    double squared_sum = 0.0;  // Σ |p − p'|²
    uint64_t num_vertices = 0;
    double worst = 0.0;  // scene units
    uint32_t worst_vertex = 0;
    uint32_t worst_pose = 0;

    double rms() const;

    void add(std::span<const float> planes, std::span<const float> reference, uint32_t pose);
};

}  // namespace paim
