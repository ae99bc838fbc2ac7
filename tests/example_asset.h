// A small compressed animation with known numbers.
#pragma once

#include <algorithm>
#include <cmath>
#include <functional>
#include <utility>
#include <vector>

#include "paim/base/seed.h"
#include "paim/codec/asset.h"
#include "paim/codec/cpca/cpca_transfer.h"
#include "paim/codec/svd/svd_transfer.h"

namespace paim {

// A tetrahedron with random components. Weights fall off, so that components have an order.
inline Asset make_example_asset(const TransferLayout& layout, uint32_t num_poses = 5,
                                uint32_t num_components = 3) {
    RandomStream random(7);
    Asset asset;
    asset.name = "example";
    asset.provenance_json = R"({"made":"by a test"})";
    CodedMesh& mesh = asset.moving();
    mesh.topology = {4, {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}}};
    mesh.layout = layout;
    const auto fill = [&](uint32_t num_planes) {
        LowRank matrix;
        matrix.num_points = 4;
        matrix.num_planes = num_planes;
        matrix.num_poses = num_poses;
        matrix.num_components = num_components;
        const auto number = [&] { return static_cast<float>(2.0 * random.uniform() - 1.0); };
        std::vector<float> rows(matrix.num_rows());
        std::generate(rows.begin(), rows.end(), number);
        matrix.mean = rows;
        for (uint32_t k = 0; k < num_components; ++k) {
            std::generate(rows.begin(), rows.end(), number);
            matrix.components.emplace_back(rows);
        }
        matrix.weights.resize(size_t{num_components} * num_poses);
        std::generate(matrix.weights.begin(), matrix.weights.end(), number);
        for (uint32_t k = 0; k < num_components; ++k) {
            matrix.singular_values.push_back(std::pow(0.5, k) * (num_planes == 3 ? 1.0 : 0.9));
        }
        return matrix;
    };
    mesh.positions = fill(3);
    mesh.transfer = SvdTransfer(fill(mesh.layout.num_planes()));
    return asset;
}
inline Asset make_example_asset(uint32_t bands = 2, uint32_t channels = 1, uint32_t num_poses = 5,
                                uint32_t num_components = 3) {
    return make_example_asset({TransferKind::diffuse, bands, channels}, num_poses, num_components);
}

// The same with integers instead of floats: i16 components, of which the last are i8.
inline Asset quantise_example(Asset asset) {
    RandomStream random(9);
    for (LowRank* matrix : {&asset.moving().positions, &asset.moving().transfer->matrix}) {
        const auto integer = [&](double limit) { return limit * (2.0 * random.uniform() - 1.0); };
        matrix->precision = Precision::i16;
        for (uint32_t j = 0; j < matrix->num_planes; ++j) {
            matrix->steps.push_back(0.001f * static_cast<float>(1 + j));
        }
        std::vector<int16_t> wide(matrix->num_rows());
        std::vector<int8_t> narrow(matrix->num_rows());
        const auto fill_wide = [&] {
            for (int16_t& q : wide) q = static_cast<int16_t>(integer(2000));
        };
        fill_wide();
        matrix->mean = wide;
        for (uint32_t k = 0; k < matrix->num_components; ++k) {
            fill_wide();
            for (int8_t& q : narrow) q = static_cast<int8_t>(integer(127));
            matrix->components[k] =
                2 * k < matrix->num_components ? StoredValues(wide) : StoredValues(narrow);
        }
    }
    return asset;
}

// The tetrahedron with clustered transfer: two clusters of two vertices, and so many components in
// each; components over time and numbers as in make_example_asset().
inline Asset make_clustered_example(const TransferLayout& layout,
                                    uint32_t num_cluster_components = 1, bool integers = false) {
    RandomStream random(10);
    const auto number = [&] { return static_cast<float>(2.0 * random.uniform() - 1.0); };
    Asset asset = make_example_asset(layout);
    VertexClusters clusters;
    clusters.num_clusters = 2;
    clusters.num_components = num_cluster_components;
    clusters.cluster = {1, 0, 0, 1};
    for (uint32_t j = 0; j < num_cluster_components; ++j) {
        if (integers) {
            clusters.coefficients.emplace_back(std::vector<int8_t>{-127, 3, 0, 90});
        } else {
            std::vector<float> values(4);
            std::generate(values.begin(), values.end(), number);
            clusters.coefficients.emplace_back(values);
        }
    }
    clusters.scales.resize(clusters.num_rows());
    std::generate(clusters.scales.begin(), clusters.scales.end(), number);
    LowRank matrix = asset.moving().transfer->matrix;
    matrix.num_points = clusters.num_rows();
    std::vector<float> rows(matrix.num_rows());
    const auto fill = [&] {
        std::generate(rows.begin(), rows.end(), number);
        return rows;
    };
    matrix.mean = fill();
    for (StoredValues& component : matrix.components) component = fill();
    asset.moving().transfer = CpcaTransfer(std::move(matrix), std::move(clusters));
    return integers ? quantise_example(asset) : asset;
}
inline Asset make_clustered_example(uint32_t bands = 2, uint32_t channels = 1,
                                    uint32_t num_cluster_components = 1, bool integers = false) {
    return make_clustered_example({TransferKind::diffuse, bands, channels}, num_cluster_components,
                                  integers);
}

// A still part: two triangles of three colours.
inline CodedMesh make_example_still(const TransferLayout& layout) {
    RandomStream random(8);
    CodedMesh mesh;
    mesh.topology = {4, {{0, 1, 2}, {1, 3, 2}}};
    mesh.albedo.values = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {0.5f, 0.5f, 0.5f}};
    mesh.layout = layout;
    const auto number = [&] { return static_cast<float>(2.0 * random.uniform() - 1.0); };
    const auto still = [&](uint32_t num_planes) {
        std::vector<float> values(size_t{4} * num_planes);
        std::generate(values.begin(), values.end(), number);
        return LowRank::still(num_planes, std::move(values));
    };
    mesh.positions = still(3);
    mesh.transfer = SvdTransfer(still(layout.num_planes()));
    return mesh;
}

// The same in integers: positions i16, transfer i8, a step a plane.
inline CodedMesh make_quantised_still(const TransferLayout& layout) {
    CodedMesh mesh = make_example_still(layout);
    const auto quantise = [](LowRank& matrix, auto largest) {
        using Integer = decltype(largest);
        std::vector<Integer> integers;
        for (const float value : matrix.mean.floats()) {
            integers.push_back(static_cast<Integer>(std::lround(value * largest)));
        }
        std::vector<float> steps;
        for (uint32_t j = 0; j < matrix.num_planes; ++j) {
            steps.push_back(static_cast<float>(1 + j) / static_cast<float>(largest));
        }
        matrix = LowRank::still(matrix.num_planes, std::move(integers), std::move(steps));
    };
    quantise(mesh.positions, int16_t{1000});
    quantise(mesh.transfer->matrix, int8_t{100});
    return mesh;
}

// The example with a still part.
inline Asset with_still(Asset asset, CodedMesh still) {
    asset.parts.push_back(std::move(still));
    return asset;
}

// Integers, clustered or not, with weights that are integers, too, as the encoder makes them.
inline Asset make_packed_example(bool clustered) {
    Asset asset = clustered ? make_clustered_example(3, 3, 2, true)
                            : quantise_example(make_example_asset(3, 3));
    asset.vertex_order = VertexOrder::cache;
    LowRank& matrix = asset.moving().transfer->matrix;
    matrix.weight_steps = {0.25f, 0.0f, 1e-3f};
    for (size_t j = 0; j < matrix.weights.size(); ++j) {
        const float step = matrix.weight_steps[j / matrix.num_poses];
        const auto q = static_cast<int32_t>(j * 977 % 4001) - 2000;
        matrix.weights[j] = step * static_cast<float>(q);
    }
    return asset;
}

}  // namespace paim
