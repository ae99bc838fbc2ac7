// Bands that hold nothing are not stored.
#include "compressor/encode/quantise/trim_bands.h"

#include <vector>

namespace paim {

namespace {

bool all_zero(const StoredValues& values, size_t first, size_t count) {
    bool zero = true;
    values.for_each(first, count, [&](size_t, float value) { zero = zero && value == 0.0f; });
    return zero;
}

bool plane_is_zero(const LowRankMatrix& matrix, uint32_t plane) {
    const size_t first = size_t{plane} * matrix.num_points;
    if (!all_zero(matrix.mean, first, matrix.num_points)) return false;
    for (const StoredValues& component : matrix.components) {
        if (!all_zero(component, first, matrix.num_points)) return false;
    }
    return true;
}

StoredValues keep_planes(const StoredValues& values, const std::vector<uint32_t>& planes,
                         size_t num_points) {
    return std::visit(
        [&](const auto& all) {
            std::decay_t<decltype(all)> kept;
            kept.reserve(planes.size() * num_points);
            for (const uint32_t plane : planes) {
                const auto first = all.begin() + static_cast<ptrdiff_t>(plane * num_points);
                kept.insert(kept.end(), first, first + static_cast<ptrdiff_t>(num_points));
            }
            return StoredValues(std::move(kept));
        },
        values.values());
}

std::vector<float> keep_steps(const std::vector<float>& steps,
                              const std::vector<uint32_t>& planes) {
    std::vector<float> kept;
    if (steps.empty()) return kept;
    for (const uint32_t plane : planes) kept.push_back(steps[plane]);
    return kept;
}

}  // namespace

void trim_bands(Model& model) {
    LowRankMatrix& matrix = model.transfer;
    TransferLayout trimmed = model.layout;
    const size_t num_still = model.scenery.topology.num_vertices;
    const auto band_is_zero = [&](uint32_t band) {
        for (uint32_t channel = 0; channel < model.layout.channels; ++channel) {
            for (uint32_t i = band * band; i < (band + 1) * (band + 1); ++i) {
                const uint32_t plane = model.layout.plane(channel, i);
                if (!plane_is_zero(matrix, plane) ||
                    !all_zero(model.scenery.transfer.values, plane * num_still, num_still)) {
                    return false;
                }
            }
        }
        return true;
    };
    while (trimmed.bands > 1 && band_is_zero(trimmed.bands - 1)) --trimmed.bands;
    if (trimmed == model.layout) return;
    std::vector<uint32_t> planes;
    for (uint32_t channel = 0; channel < trimmed.channels; ++channel) {
        for (uint32_t i = 0; i < trimmed.num_coefficients(); ++i) {
            planes.push_back(model.layout.plane(channel, i));
        }
    }
    matrix.mean = keep_planes(matrix.mean, planes, matrix.num_points);
    for (StoredValues& component : matrix.components) {
        component = keep_planes(component, planes, matrix.num_points);
    }
    matrix.steps = keep_steps(matrix.steps, planes);
    matrix.num_planes = trimmed.num_planes();
    model.layout = trimmed;
    StillPlanes& still = model.scenery.transfer;
    still.values = keep_planes(still.values, planes, num_still);
    still.steps = keep_steps(still.steps, planes);
}

}  // namespace paim
