// Reading and scaling.
#include "player/read_asset.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "paim/mesh/unit_scale.h"

namespace paim::player {

namespace {

// The largest magnitude of values [planes][N] of a matrix, steps applied.
double largest_magnitude(const LowRank& matrix, const StoredValues& values) {
    double largest = 0.0;
    for (uint32_t j = 0; j < matrix.num_planes; ++j) {
        const double step = double{matrix.step(j)};
        values.for_each(size_t{j} * matrix.num_points, matrix.num_points, [&](size_t, float value) {
            largest = std::max(largest, std::abs(step * double{value}));
        });
    }
    return largest;
}

// The most that a component adds to a coordinate in any pose.
double largest_offset(const LowRank& matrix) {
    double largest = 0.0;
    for (size_t k = 0; k < matrix.num_components; ++k) {
        const float* weights = matrix.weights.data() + k * matrix.num_poses;
        double weight = 0.0;
        for (size_t p = 0; p < matrix.num_poses; ++p) {
            weight = std::max(weight, std::abs(double{weights[p]}));
        }
        largest = std::max(largest, weight * largest_magnitude(matrix, matrix.components[k]));
    }
    return largest;
}

void multiply(std::vector<float>& values, float scale) {
    for (float& value : values) value *= scale;
}

// The weights of exceptions may be as large as floats are; sums with them stay finite.
void multiply_weights(std::vector<float>& weights, float scale) {
    constexpr float kMost = 1e37f;
    for (float& weight : weights) weight = std::clamp(weight * scale, -kMost, kMost);
}

// Integers by their steps, floats by the mean and the weights.
void multiply(LowRank& matrix, float scale) {
    for (double& value : matrix.singular_values) value *= double{scale};
    if (!matrix.steps.empty()) return multiply(matrix.steps, scale);
    std::vector<float> floats = matrix.mean.floats();
    multiply(floats, scale);
    matrix.mean = StoredValues(std::move(floats));
    multiply_weights(matrix.weights, scale);
    multiply(matrix.weight_steps, scale);
}

}  // namespace

std::shared_ptr<const Asset> read_asset(const std::filesystem::path& path,
                                        const ReadOptions& options, SceneUnits* units) {
    Asset asset = read_paim(path, options);
    const Vec3d origin = asset.origin;
    const float scale = scale_to_unit(asset);
    if (units != nullptr) *units = {double{scale}, origin};
    return std::make_shared<const Asset>(std::move(asset));
}

float scale_to_unit(Asset& asset) {
    // Every prefix of a file has the mean; only where that is one point do components decide.
    const LowRank& moving = asset.moving().positions;
    double largest = largest_magnitude(moving, moving.mean);
    if (largest == 0.0) largest = largest_offset(moving);
    // A still part or a path that is larger than anything must stay finite.
    for (const CodedMesh& part : asset.parts) {
        for (const RigidTransform& root : part.root_motion) {
            largest = std::max(largest, 0x1p-60 * root.translation.cwiseAbs().maxCoeff());
        }
        largest =
            std::max(largest, 0x1p-60 * largest_magnitude(part.positions, part.positions.mean));
    }
    const float scale = unit_scale(largest);
    if (scale == 1.0f) return scale;
    for (CodedMesh& part : asset.parts) {
        multiply(part.positions, scale);
        for (RigidTransform& root : part.root_motion) root.translation *= double{scale};
    }
    asset.origin *= double{scale};
    return scale;
}

}  // namespace paim::player
