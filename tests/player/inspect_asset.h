// An animation of one square, whose numbers can be followed by hand.
#pragma once

#include <memory>
#include <utility>
#include <vector>

#include "paim/codec/asset.h"
#include "paim/codec/svd/svd_transfer.h"

namespace paim::player {

// A matrix of four points and two poses, in which one component has the weights +1 and +½.
inline LowRank four_points(std::vector<float> mean, std::vector<float> component) {
    LowRank matrix;
    matrix.num_points = 4;
    matrix.num_planes = static_cast<uint32_t>(mean.size() / 4);
    matrix.num_poses = 2;
    matrix.num_components = 1;
    matrix.mean = std::move(mean);
    matrix.components = {StoredValues(std::move(component))};
    matrix.weights = {1.0f, 0.5f};
    matrix.singular_values = {3.0, 1.0};
    return matrix;
}

// A rectangle of 3 x 4 that faces +z. Its diagonal is 5, and its albedo is a half. In pose 0 vertex 3 is
// 0.5 too high over it, in pose 1 0.25.
// mean, component  [bands² · channels][4] of the transfer
inline Asset square_asset(uint32_t bands, uint32_t channels, std::vector<float> mean,
                          std::vector<float> component) {
    Asset asset;
    asset.name = "square";
    CodedMesh& mesh = asset.moving();
    mesh.topology = {4, {{0, 1, 2}, {1, 3, 2}}};
    mesh.albedo.values = {Vec3f::Constant(0.5f)};
    mesh.layout.in_bands = bands;
    mesh.layout.channels = channels;
    mesh.positions =
        four_points({0, 3, 0, 3, 0, 0, 4, 4, 0, 0, 0, 0}, {0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0.5f});
    mesh.transfer = SvdTransfer(four_points(std::move(mean), std::move(component)));
    return asset;
}

inline std::shared_ptr<const Asset> shared(Asset asset) {
    return std::make_shared<const Asset>(std::move(asset));
}

}  // namespace paim::player
