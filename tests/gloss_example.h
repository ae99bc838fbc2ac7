// Small animations with gloss, of known numbers.
#pragma once

#include <numeric>
#include <string>
#include <utility>
#include <vector>

#include "paim/codec/gloss_asset.h"
#include "tests/example_asset.h"

namespace paim {

// Gloss of 3 bands of light and 2 of outgoing radiance, whose vertices have tints of their own.
inline Asset make_gloss_alone(uint32_t channels, bool clustered, bool integers) {
    const TransferLayout layout{TransferKind::glossy, 3, channels, 2};
    Asset asset =
        clustered ? make_clustered_example(layout, 2, integers) : make_example_asset(layout);
    if (integers && !clustered) asset = quantise_example(std::move(asset));
    asset.provenance_json = R"({"made":"of glass"})";
    asset.moving().albedo.values = {{1, 0.5f, 0.25f}, {0, 1, 0}, {1, 1, 1}, {0.75f, 1, 1}};
    return asset;
}

// The example of 2 bands with this gloss on all of its vertices.
inline Asset with_gloss(Asset gloss, Asset whole = make_example_asset(2, 1)) {
    std::vector<uint32_t> all(gloss.moving().topology.num_vertices);
    std::iota(all.begin(), all.end(), 0u);
    join_gloss(std::move(gloss), all, all, whole);
    return whole;
}

// The first three points of four alone.
inline LowRank first_three(LowRank matrix) {
    const auto keep = [&](StoredValues& values) {
        std::vector<float> kept;
        for (size_t j = 0; j < values.size(); ++j) {
            if (j % 4 < 3) kept.push_back(values[j]);
        }
        values = kept;
    };
    keep(matrix.mean);
    for (StoredValues& component : matrix.components) keep(component);
    matrix.num_points = 3;
    return matrix;
}

// The example with gloss on vertices 3, 0 and 2, which are its rows 0, 1 and 2.
inline Asset with_partial_gloss() {
    Asset gloss = make_gloss_alone(1, false, false);
    CodedMesh& mesh = gloss.moving();
    mesh.topology = {3, {{1, 2, 0}}};
    mesh.albedo.values.resize(3);
    mesh.positions = first_three(mesh.positions);
    mesh.transfer = SvdTransfer(first_three(mesh.transfer->matrix));
    Asset whole = make_example_asset(2, 1);
    const std::vector<uint32_t> vertices{3, 0, 2};
    join_gloss(std::move(gloss), vertices, {}, whole);
    return whole;
}

struct GlossVariant {
    std::string name;
    Asset asset;
};

// Both codecs, floats and integers, grey and coloured, on all vertices and on some.
inline std::vector<GlossVariant> gloss_variants() {
    std::vector<GlossVariant> variants;
    for (const uint32_t channels : {1u, 3u}) {
        for (const bool clustered : {false, true}) {
            for (const bool integers : {false, true}) {
                variants.push_back({std::string(clustered ? "cpca" : "svd") +
                                        (integers ? " of integers, " : ", ") +
                                        std::to_string(channels) + " channels",
                                    with_gloss(make_gloss_alone(channels, clustered, integers))});
            }
        }
    }
    variants.push_back({"some vertices", with_partial_gloss()});
    return variants;
}

}  // namespace paim
