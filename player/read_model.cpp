// Reading and scaling.
#include "player/read_model.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "paim/mesh/unit_scale.h"

namespace paim::player {

namespace {

// The largest magnitude of values [planes][N] that count steps [planes], or, without steps, ones.
double largest_magnitude(const StoredValues& values, const std::vector<float>& steps) {
    const size_t num_planes = std::max<size_t>(1, steps.size());
    const size_t num_points = values.size() / num_planes;
    double largest = 0.0;
    for (size_t j = 0; j < num_planes; ++j) {
        const double step = steps.empty() ? 1.0 : static_cast<double>(steps[j]);
        values.for_each(j * num_points, num_points, [&](size_t, float value) {
            largest = std::max(largest, std::abs(step * static_cast<double>(value)));
        });
    }
    return largest;
}

// The most that a component adds to a coordinate in any pose.
double largest_offset(const LowRankMatrix& matrix) {
    double largest = 0.0;
    for (size_t k = 0; k < matrix.num_components; ++k) {
        const float* weights = matrix.weights.data() + k * matrix.num_poses;
        double weight = 0.0;
        for (size_t p = 0; p < matrix.num_poses; ++p) {
            weight = std::max(weight, std::abs(static_cast<double>(weights[p])));
        }
        largest = std::max(largest, weight * largest_magnitude(matrix.components[k], matrix.steps));
    }
    return largest;
}

void multiply(std::vector<float>& values, float scale) {
    for (float& value : values) value *= scale;
}

// The values, or the steps that they count.
void multiply(StoredValues& values, std::vector<float>& steps, float scale) {
    if (!steps.empty()) return multiply(steps, scale);
    std::vector<float> floats = values.floats();
    multiply(floats, scale);
    values = StoredValues(std::move(floats));
}

}  // namespace

Model read_model(const std::filesystem::path& path, const ReadOptions& options) {
    Model model = read_paim(path, options);
    scale_to_unit(model);
    return model;
}

void scale_to_unit(Model& model) {
    // Every prefix of a file has the mean; only where that is one point do components decide.
    LowRankMatrix& geometry = model.geometry;
    double largest = largest_magnitude(geometry.mean, geometry.steps);
    if (largest == 0.0) largest = largest_offset(geometry);
    // Scenery that is larger than anything must stay finite.
    StillPlanes& scenery = model.scenery.positions;
    largest = std::max(largest, 0x1p-60 * largest_magnitude(scenery.values, scenery.steps));
    const float scale = unit_scale(largest);
    if (scale == 1.0f) return;

    const bool has_steps = !geometry.steps.empty();
    multiply(geometry.mean, geometry.steps, scale);
    if (!has_steps) {
        multiply(geometry.weights, scale);
        multiply(geometry.weight_steps, scale);
    }
    if (!model.scenery.empty()) multiply(scenery.values, scenery.steps, scale);
    for (double& value : geometry.singular_values) value *= static_cast<double>(scale);
    model.origin *= static_cast<double>(scale);
}

}  // namespace paim::player
