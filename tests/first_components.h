// A compressed animation with its first components only.
#pragma once

#include "paim/codec/asset.h"

namespace paim {

inline Asset first_components(Asset model, uint32_t num_geometry, uint32_t num_transfer) {
    const auto cut = [](LowRank& matrix, uint32_t num_components) {
        matrix.num_components = num_components;
        matrix.components.resize(num_components);
        matrix.weights.resize(size_t{num_components} * matrix.num_poses);
        if (!matrix.weight_steps.empty()) matrix.weight_steps.resize(num_components);
        if (!matrix.singular_indices.empty()) matrix.singular_indices.resize(num_components);
    };
    cut(model.moving().positions, num_geometry);
    cut(model.moving().transfer->matrix, num_transfer);
    return model;
}

}  // namespace paim
