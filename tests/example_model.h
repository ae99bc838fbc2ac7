// A small compressed animation with known numbers.
#pragma once

#include <algorithm>
#include <cmath>
#include <functional>

#include "paim/base/seed.h"
#include "paim/codec/model.h"

namespace paim {

// A tetrahedron with random components. Weights fall off, so that components have an order.
inline Model make_example_model(uint32_t bands = 2, uint32_t channels = 1, uint32_t num_poses = 5,
                                uint32_t num_components = 3) {
    RandomStream random(7);
    Model model;
    model.name = "example";
    model.provenance_json = R"({"made":"by a test"})";
    model.topology = {4, {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}}};
    model.layout = {TransferKind::diffuse, bands, channels};
    const auto fill = [&](uint32_t num_planes) {
        LowRankMatrix matrix;
        matrix.num_vertices = 4;
        matrix.num_planes = num_planes;
        matrix.num_poses = num_poses;
        matrix.num_components = num_components;
        const auto number = [&] { return static_cast<float>(2.0 * random.uniform() - 1.0); };
        matrix.mean.resize(matrix.num_rows());
        matrix.components.resize(num_components * matrix.num_rows());
        matrix.weights.resize(size_t{num_components} * num_poses);
        std::generate(matrix.mean.begin(), matrix.mean.end(), number);
        std::generate(matrix.components.begin(), matrix.components.end(), number);
        std::generate(matrix.weights.begin(), matrix.weights.end(), number);
        for (uint32_t k = 0; k < num_components; ++k) {
            matrix.singular_values.push_back(std::pow(0.5, k) * (num_planes == 3 ? 1.0 : 0.9));
        }
        return matrix;
    };
    model.geometry = fill(3);
    model.transfer = fill(model.layout.num_planes());
    return model;
}

// Two triangles of three colours.
inline Scenery make_example_scenery(const TransferLayout& layout) {
    RandomStream random(8);
    Scenery scenery;
    scenery.topology = {4, {{0, 1, 2}, {1, 3, 2}}};
    scenery.albedo.values = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {0.5f, 0.5f, 0.5f}};
    const auto number = [&] { return static_cast<float>(2.0 * random.uniform() - 1.0); };
    scenery.positions.resize(size_t{3} * 4);
    scenery.transfer.resize(size_t{layout.num_planes()} * 4);
    std::generate(scenery.positions.begin(), scenery.positions.end(), number);
    std::generate(scenery.transfer.begin(), scenery.transfer.end(), number);
    return scenery;
}

}  // namespace paim
