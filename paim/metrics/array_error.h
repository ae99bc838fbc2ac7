// Errors of decoded values to the baked ones: the worst value and its place, RMS, and relative
// error.
#pragma once

#include <cstdint>
#include <span>

namespace paim {

// Error of values over all poses that are added.
struct ArrayError {
    double squared_sum = 0.0;            // Σ (a − b)²
    double reference_squared_sum = 0.0;  // Σ b²
    uint64_t num_values = 0;
    double worst = 0.0;  // largest |a − b|
    uint64_t worst_index = 0;
    uint32_t worst_pose = 0;

    // Both are not a number if nothing was added.
    double rms() const;
    double relative() const;  // ‖a − b‖ / ‖b‖; 0 where values were compared that are all 0

    // Adds the values of one pose; the spans have the same length (checked).
    void add(std::span<const float> values, std::span<const float> reference, uint32_t pose);
};

// Error of points over all poses that are added, as distances. Planes x, y, z of V values each,
// scene units.
struct DistanceError {
    double squared_sum = 0.0;  // Σ |p − p'|²
    uint64_t num_vertices = 0;
    double worst = 0.0;  // scene units
    uint32_t worst_vertex = 0;
    uint32_t worst_pose = 0;

    double rms() const;  // not a number if nothing was added

    void add(std::span<const float> planes, std::span<const float> reference, uint32_t pose);
};

}  // namespace paim
