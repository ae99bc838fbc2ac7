// A compressed animation with its first components only.
#pragma once

#include "paim/codec/model.h"

namespace paim {

inline Model first_components(Model model, uint32_t num_geometry, uint32_t num_transfer) {
    const auto cut = [](LowRankMatrix& matrix, uint32_t num_components) {
        matrix.num_components = num_components;
        matrix.components.resize(num_components);
        matrix.weights.resize(size_t{num_components} * matrix.num_poses);
        if (!matrix.weight_steps.empty()) matrix.weight_steps.resize(num_components);
        if (!matrix.singular_indices.empty()) matrix.singular_indices.resize(num_components);
    };
    cut(model.geometry, num_geometry);
    cut(model.transfer, num_transfer);
    return model;
}

}  // namespace paim
