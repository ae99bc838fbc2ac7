// Errors of decoded positions to the baked ones, in the measures of the mesh compression
// literature.
// Based on: Karni and Gotsman 2004; Kavan, Sloan and O'Sullivan 2010 (see the header)
#include "paim/metrics/geometry_error.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "paim/base/check.h"

namespace paim {

namespace {

double ratio(double part, double whole) {
    if (whole > 0.0) return part / whole;
    return part > 0.0 ? std::numeric_limits<double>::infinity() : part;
}

}  // namespace

double GeometryError::worst() const {
    return distance.num_vertices > 0 ? distance.worst : std::numeric_limits<double>::quiet_NaN();
}

double GeometryError::relative_rms() const {
    return ratio(distance.rms(), diagonal);
}

double GeometryError::relative_worst() const {
    return ratio(worst(), diagonal);
}

double GeometryError::kg_error() const {
    if (distance.num_vertices == 0) return std::numeric_limits<double>::quiet_NaN();
    return 100.0 * ratio(std::sqrt(distance.squared_sum), std::sqrt(centred_squared_sum));
}

double GeometryError::e_rms() const {
    // ‖A − A'‖_F / √(V P) is the RMS distance.
    return 1000.0 * ratio(distance.rms() / std::sqrt(3.0), 0.5 * diagonal);
}

void GeometryError::add(std::span<const float> positions, std::span<const float> reference,
                        uint32_t pose, size_t num_sized) {
    PAIM_CHECK_EQ(reference.size() % 3, 0u);
    distance.add(positions, reference, pose);
    const size_t count = reference.size() / 3;
    if (count == 0) return;
    if (num_sized == 0 || num_sized > count) num_sized = count;
    double extent_squared = 0.0;
    for (size_t axis = 0; axis < 3; ++axis) {
        const auto plane = reference.subspan(axis * count, count);
        double sum = 0.0;
        for (const float x : plane) sum += static_cast<double>(x);
        const double mean = sum / static_cast<double>(count);
        for (const float x : plane) {
            const double centred = static_cast<double>(x) - mean;
            centred_squared_sum += centred * centred;
        }
        const auto [lowest, highest] =
            std::minmax_element(plane.begin(), plane.begin() + static_cast<ptrdiff_t>(num_sized));
        const double extent = static_cast<double>(*highest) - static_cast<double>(*lowest);
        extent_squared += extent * extent;
    }
    diagonal = std::max(diagonal, std::sqrt(extent_squared));
}

}  // namespace paim
