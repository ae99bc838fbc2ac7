// A .paim with compressed sections, put together in memory.
#include "paim/format/paim/paim_packer.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>

#include "paim/base/check.h"
#include "paim/base/error.h"
#include "paim/base/half.h"
#include "paim/base/parallel.h"
#include "paim/format/container/mesh_sections.h"
#include "paim/format/container/sections.h"
#include "paim/format/pack/index_codec.h"
#include "paim/format/pack/plane_codec.h"
#include "paim/format/paim/paim_file.h"
#include "paim/format/paim/paim_metadata.h"

namespace paim {

namespace {

constexpr Attribute kAttributes[] = {Attribute::geometry, Attribute::transfer};

// A section before it is compressed.
struct Task {
    SectionSpec spec;
    SectionCodec codec;
    std::function<std::vector<uint8_t>()> compress;
};

template <typename T>
std::vector<uint8_t> as_bytes(std::span<const T> values) {
    const auto* first = reinterpret_cast<const uint8_t*>(values.data());
    return {first, first + values.size_bytes()};
}

template <typename T>
Task zstd_task(const SectionSpec& spec, std::span<const T> values) {
    PAIM_CHECK_EQ(values.size_bytes(), spec.size_bytes());
    return {spec, SectionCodec::zstd, [values] { return zstd_compress(as_bytes(values)); }};
}

SectionSpec row_spec(Tag tag, ScalarType type, size_t size) {
    return {tag, type, 0, {1, 1, static_cast<uint32_t>(size)}};
}

// Values of a matrix or coefficients: integers predicted, floats as they are.
Task values_task(Tag tag, uint32_t index, uint32_t num_planes, uint32_t num_points,
                 const StoredValues& values, Precision precision, const PlanePredictor& predictor,
                 Effort effort) {
    SectionSpec spec{tag, ScalarType::f32, index, {1, num_planes, num_points}};
    PAIM_CHECK_EQ(values.size(), spec.num_values());
    if (!values.holds_floats()) {
        spec.type = values.holds_i8() ? ScalarType::i8 : ScalarType::i16;
        return {spec, SectionCodec::planes, [&values, num_planes, &predictor, effort] {
                    return encode_planes(values, num_planes, predictor, effort);
                }};
    }
    if (precision != Precision::f16) {
        return {spec, SectionCodec::none,
                [&values] { return as_bytes(std::span(values.floats())); }};
    }
    spec.type = ScalarType::f16;
    return {spec, SectionCodec::none, [&values] {
                const auto& floats = values.floats();
                std::vector<uint16_t> halves(floats.size());
                std::transform(floats.begin(), floats.end(), halves.begin(), to_half);
                return as_bytes(std::span<const uint16_t>(halves));
            }};
}

// Weights [K][P] as multiples of their steps, which they are.
StoredValues weight_integers(const LowRankMatrix& matrix) {
    std::vector<int16_t> integers(matrix.weights.size());
    for (size_t j = 0; j < integers.size(); ++j) {
        const float step = matrix.weight_steps[j / matrix.num_poses];
        const float q = step > 0.0f ? std::nearbyint(matrix.weights[j] / step) : 0.0f;
        PAIM_CHECK(std::abs(q) <= 32767.0f);
        integers[j] = static_cast<int16_t>(q);
        PAIM_CHECK_EQ(static_cast<float>(integers[j]) * step, matrix.weights[j]);
    }
    return integers;
}

std::vector<uint8_t> packed_singular_values(const LowRankMatrix& matrix) {
    const std::vector<float> rounded(matrix.singular_values.begin(), matrix.singular_values.end());
    if (!rounded.empty() && std::isinf(rounded[0])) {
        throw_bad_input("a singular value is {}, expected at most {}: scale the poses down",
                        matrix.singular_values[0], std::numeric_limits<float>::max());
    }
    return zstd_compress(as_bytes(std::span(rounded)));
}

// All but means and components.
void add_frame(std::vector<Task>& tasks, Attribute attribute, const LowRankMatrix& matrix,
               const PlanePredictor& poses) {
    const auto i = static_cast<size_t>(attribute);
    tasks.push_back(
        {row_spec(section::kSingularValues[i], ScalarType::f32, matrix.singular_values.size()),
         SectionCodec::zstd, [&matrix] { return packed_singular_values(matrix); }});
    SectionSpec weights{
        section::kWeights[i], ScalarType::f32, 0, {1, matrix.num_components, matrix.num_poses}};
    if (matrix.weight_steps.empty() || matrix.num_components == 0) {
        tasks.push_back(zstd_task(weights, std::span(matrix.weights)));
    } else {
        weights.type = ScalarType::i16;
        tasks.push_back({weights, SectionCodec::planes, [&matrix, &poses] {
                             return encode_planes(weight_integers(matrix), matrix.num_components,
                                                  poses);
                         }});
        tasks.push_back(
            zstd_task(row_spec(section::kWeightSteps[i], ScalarType::f32, matrix.num_components),
                      std::span(matrix.weight_steps)));
    }
    if (!matrix.steps.empty()) {
        tasks.push_back(zstd_task(row_spec(section::kSteps[i], ScalarType::f32, matrix.num_planes),
                                  std::span(matrix.steps)));
    }
}

void add_scenery(std::vector<Task>& tasks, const Model& model, const PlanePredictor& predictor,
                 Effort effort) {
    const Scenery& scenery = model.scenery;
    if (scenery.empty()) return;
    const uint32_t num_vertices = scenery.topology.num_vertices;
    const auto planes = [&](Tag tag, Tag tag_of_steps, uint32_t count, const StillPlanes& still) {
        if (still.values.holds_floats()) {
            tasks.push_back(zstd_task({tag, ScalarType::f32, 0, {1, count, num_vertices}},
                                      std::span(still.values.floats())));
            return;
        }
        tasks.push_back(
            zstd_task(row_spec(tag_of_steps, ScalarType::f32, count), std::span(still.steps)));
        tasks.push_back(values_task(tag, 0, count, num_vertices, still.values, Precision::f32,
                                    predictor, effort));
    };
    tasks.push_back({triangles_spec(scenery.topology, section::kSceneryTriangles),
                     SectionCodec::indices,
                     [&scenery] { return encode_triangles(scenery.topology); }});
    planes(section::kSceneryPositions, section::kSceneryPositionSteps, 3, scenery.positions);
    tasks.push_back(zstd_task(albedo_spec(scenery.albedo, section::kSceneryAlbedo),
                              std::span(scenery.albedo.values)));
    planes(section::kSceneryTransfer, section::kSceneryTransferSteps, model.layout.num_planes(),
           scenery.transfer);
}

}  // namespace

bool needs_packing(const Model& model) {
    const auto integers = [](const LowRankMatrix& matrix) {
        return !matrix.mean.holds_floats() || !matrix.weight_steps.empty() ||
               std::any_of(matrix.components.begin(), matrix.components.end(),
                           [](const StoredValues& values) { return !values.holds_floats(); });
    };
    return !model.clusters.empty() || integers(model.geometry) || integers(model.transfer) ||
           !model.scenery.positions.values.holds_floats() ||
           !model.scenery.transfer.values.holds_floats();
}

PackedFile::PackedFile(const Model& model, Effort effort) {
    const uint32_t num_vertices = model.topology.num_vertices;
    const VertexClusters& clusters = model.clusters;
    const std::string metadata = paim_metadata(model);
    const PlanePredictor vertices(model.topology);
    const PlanePredictor poses = PlanePredictor::chain(model.num_poses());
    const PlanePredictor rows;  // of bases, in no order
    const auto predictor = [&](Attribute attribute) -> const PlanePredictor& {
        return attribute == Attribute::transfer && !clusters.empty() ? rows : vertices;
    };
    std::vector<Task> tasks;
    tasks.push_back(zstd_task(row_spec(section::kMetadata, ScalarType::u8, metadata.size()),
                              std::span(metadata)));
    tasks.push_back({triangles_spec(model.topology), SectionCodec::indices,
                     [&model] { return encode_triangles(model.topology); }});
    tasks.push_back(zstd_task(albedo_spec(model.albedo), std::span(model.albedo.values)));
    const PlanePredictor still_vertices(model.scenery.topology);
    add_scenery(tasks, model, still_vertices, effort);
    StoredValues cluster_numbers;
    if (!clusters.empty()) {
        PAIM_CHECK_EQ(clusters.cluster.size(), size_t{num_vertices});
        cluster_numbers = std::vector<int16_t>(clusters.cluster.begin(), clusters.cluster.end());
        tasks.push_back(values_task(section::kClusters, 0, 1, num_vertices, cluster_numbers,
                                    Precision::i16, vertices, effort));
        tasks.push_back(zstd_task({section::kClusterScales,
                                   ScalarType::f32,
                                   0,
                                   {1, clusters.num_clusters, clusters.rows_per_cluster()}},
                                  std::span(clusters.scales)));
        for (uint32_t j = 0; j < clusters.num_components; ++j) {
            tasks.push_back(values_task(section::kClusterCoefficients, j, 1, num_vertices,
                                        clusters.coefficients[j], Precision::f32, vertices,
                                        effort));
        }
    }
    for (const Attribute attribute : kAttributes)
        add_frame(tasks, attribute, model.attribute(attribute), poses);
    const auto add_values = [&](Tag tag, uint32_t index, Attribute attribute,
                                const StoredValues& values, Precision precision) {
        const LowRankMatrix& matrix = model.attribute(attribute);
        tasks.push_back(values_task(tag, index, matrix.num_planes, matrix.num_points, values,
                                    precision, predictor(attribute), effort));
    };
    for (const Attribute attribute : kAttributes) {
        add_values(section::kMean[static_cast<size_t>(attribute)], 0, attribute,
                   model.attribute(attribute).mean, Precision::f32);
    }
    for (const auto& [attribute, k] : component_order(model)) {
        const LowRankMatrix& matrix = model.attribute(attribute);
        add_values(section::kComponent[static_cast<size_t>(attribute)], k, attribute,
                   matrix.components[k], matrix.precision);
    }

    bytes_.resize(tasks.size());
    parallel_for(tasks.size(), 1,
                 [&](size_t task, size_t) { bytes_[task] = tasks[task].compress(); });
    uint64_t value_bytes = 0;
    for (size_t j = 0; j < tasks.size(); ++j) {
        value_bytes += tasks[j].spec.size_bytes();
        plans_.emplace_back(tasks[j].spec, tasks[j].codec, bytes_[j].size());
    }
    const uint64_t readable = most_bytes_of_values(size_bytes());
    const uint64_t most_vertices = std::max(num_vertices, model.scenery.topology.num_vertices);
    if (std::max(value_bytes, PlanePredictor::kBytesAVertex * most_vertices) > readable) {
        throw_unsupported(
            "{} vertices and {} bytes of values that compress to {}: readers take at most {}",
            most_vertices, value_bytes, size_bytes(), readable);
    }
}

void PackedFile::write(const std::filesystem::path& path) const {
    ContainerWriter writer(path, section::kKindAnimation, plans_);
    for (size_t j = 0; j < bytes_.size(); ++j) {
        writer.append(j, bytes_[j].data(), bytes_[j].size());
    }
    writer.commit();
}

}  // namespace paim
