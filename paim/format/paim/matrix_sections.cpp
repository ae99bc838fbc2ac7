// A low-rank matrix, clusters and still planes from the sections of a .paim.
#include "paim/format/paim/matrix_sections.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>

#include "paim/base/check.h"
#include "paim/base/error.h"
#include "paim/base/parallel.h"
#include "paim/format/container/mesh_sections.h"
#include "paim/format/container/sections.h"
#include "paim/format/pack/plane_decoder.h"

namespace paim {

namespace {

const Section& require(const ContainerReader& reader, Tag tag, uint32_t index = 0) {
    const Section* section = reader.find(tag, index);
    if (section == nullptr) {
        throw_bad_input("{}: section {} {} is missing", reader.path(), tag.str(), index);
    }
    return *section;
}

// out [sections]: integers of sections of the same type and shape, undone side by side.
template <typename Integer>
void read_integers(const ContainerReader& reader, std::span<const Section* const> sections,
                   const PlanePredictor& predictor, WorkspacePool& pool, StoredValues* out) {
    std::vector<std::vector<uint8_t>> stored;
    std::vector<std::vector<Integer>> values;
    std::vector<StoredPlanes<Integer>> planes;
    for (const Section* section : sections) {
        if (section->codec != SectionCodec::planes) {
            throw_unsupported("{}: codec {} for integers", reader.label(*section),
                              static_cast<int>(section->codec));
        }
        stored.push_back(reader.read_stored(*section));
        values.emplace_back(section->spec.num_values());
        planes.push_back({stored.back(), section->spec.shape[1], values.back()});
    }
    WorkspacePool::Lease workspace(pool);
    const auto good = [&](std::span<const StoredPlanes<Integer>> some) {
        return some[0].num_planes > 0 && decode_planes(some, predictor, *workspace);
    };
    if (!good(planes)) {
        const auto bad = std::find_if(planes.begin(), planes.end(), [&](const auto& section) {
            return !good(std::span(&section, 1));
        });
        PAIM_CHECK(bad != planes.end());
        const Section& section = *sections[static_cast<size_t>(bad - planes.begin())];
        throw_bad_input("{}: holds no {} planes of {} integers", reader.label(section),
                        section.spec.shape[1], section.spec.shape[2]);
    }
    std::move(values.begin(), values.end(), out);
}

// out [sections]: integers, or finite floats. Sections have the same type and shape.
void read_alike(const ContainerReader& reader, std::span<const Section* const> sections,
                const PlanePredictor& predictor, WorkspacePool& pool, StoredValues* out) {
    switch (sections[0]->spec.type) {
        case ScalarType::i8:
            return read_integers<int8_t>(reader, sections, predictor, pool, out);
        case ScalarType::i16:
            return read_integers<int16_t>(reader, sections, predictor, pool, out);
        case ScalarType::f16:
        case ScalarType::f32:
            for (const Section* section : sections) {
                std::vector<float> values = reader.read_f32(*section);
                check_finite(reader, section->spec.tag, values);
                *out++ = std::move(values);
            }
            return;
        default:
            throw_unsupported("{}: values of {}", reader.label(*sections[0]),
                              scalar_name(sections[0]->spec.type));
    }
}

// How many planes of this type are best undone at once.
size_t planes_at_once(ScalarType type) {
    return type == ScalarType::i8    ? kPlanesAtOnce<int8_t>
           : type == ScalarType::i16 ? kPlanesAtOnce<int16_t>
                                     : 1;
}

// Sections of the same shape.
std::vector<StoredValues> read_values(const ContainerReader& reader,
                                      std::span<const Section* const> sections,
                                      const PlanePredictor& predictor, WorkspacePool& pool) {
    std::vector<size_t> ends{0};  // of those that are read at once
    for (size_t j = 1; j < sections.size(); ++j) {
        const SectionSpec& spec = sections[j]->spec;
        const size_t num_planes = (j + 1 - ends.back()) * spec.shape[1];
        if (spec.type != sections[j - 1]->spec.type || num_planes > planes_at_once(spec.type)) {
            ends.push_back(j);
        }
    }
    if (!sections.empty()) ends.push_back(sections.size());
    std::vector<StoredValues> values(sections.size());
    parallel_for(ends.size() - 1, 1, [&](size_t j, size_t) {
        const auto some = sections.subspan(ends[j], ends[j + 1] - ends[j]);
        read_alike(reader, some, predictor, pool, &values[ends[j]]);
    });
    return values;
}

StoredValues read_values(const ContainerReader& reader, const Section& section,
                         const PlanePredictor& predictor, WorkspacePool& pool) {
    const Section* const one = &section;
    return std::move(read_values(reader, std::span(&one, 1), predictor, pool)[0]);
}

Precision precision_of(ScalarType type) {
    switch (type) {
        case ScalarType::i8:
            return Precision::i8;
        case ScalarType::i16:
            return Precision::i16;
        case ScalarType::f16:
            return Precision::f16;
        default:
            return Precision::f32;
    }
}

// What integers are multiples of: numbers from 0 up, of which 2¹⁵ are finite.
std::vector<float> read_steps(const ContainerReader& reader, Tag tag, uint32_t count) {
    const Section& section = reader.require(tag, ScalarType::f32);
    expect_shape(reader, section, 1, count);
    std::vector<float> steps = reader.read_f32(section);
    for (const float step : steps) {
        constexpr float kMax = std::numeric_limits<float>::max() / 32768.0f;
        if (!(step >= 0.0f && step <= kMax)) {
            throw_bad_input("{}: steps: expected numbers from 0 to {:.3g}, got {}",
                            reader.label(section), kMax, step);
        }
    }
    return steps;
}

void read_weights(const ContainerReader& reader, size_t i, WorkspacePool& pool,
                  LowRankMatrix& matrix) {
    const Section& section = require(reader, section::kWeights[i]);
    expect_shape(reader, section, matrix.num_components, matrix.num_poses);
    if (section.spec.type != ScalarType::i16) {
        matrix.weights = reader.read_f32(reader.require(section::kWeights[i], ScalarType::f32));
        check_finite(reader, section::kWeights[i], matrix.weights);
        return;
    }
    matrix.weight_steps = read_steps(reader, section::kWeightSteps[i], matrix.num_components);
    const StoredValues integers =
        read_values(reader, section, PlanePredictor::chain(matrix.num_poses), pool);
    matrix.weights.resize(integers.size());
    integers.widen(0, matrix.weights);
    for (size_t j = 0; j < matrix.weights.size(); ++j) {
        matrix.weights[j] *= matrix.weight_steps[j / matrix.num_poses];
    }
    check_finite(reader, section::kWeights[i], matrix.weights);
}

void read_singular_values(const ContainerReader& reader, size_t i, LowRankMatrix& matrix) {
    const Section& section = require(reader, section::kSingularValues[i]);
    if (section.spec.type == ScalarType::f32) {
        const std::vector<float> rounded = reader.read_f32(section);
        matrix.singular_values.assign(rounded.begin(), rounded.end());
    } else {
        matrix.singular_values =
            reader.read_f64(reader.require(section::kSingularValues[i], ScalarType::f64));
    }
    double previous = std::numeric_limits<double>::infinity();
    for (const double s : matrix.singular_values) {
        if (!(s >= 0.0 && s <= previous && std::isfinite(s))) {
            throw_bad_input("{}: singular values: expected finite, descending numbers, got {}",
                            reader.path(), s);
        }
        previous = s;
    }
    if (matrix.singular_values.size() < matrix.num_components) {
        throw_bad_input("{}: {} singular values, expected at least the {} components'",
                        reader.path(), matrix.singular_values.size(), matrix.num_components);
    }
}

// Of everything but the components themselves.
void keep_components(uint32_t num_components, LowRankMatrix& matrix) {
    matrix.num_components = num_components;
    matrix.weights.resize(size_t{num_components} * matrix.num_poses);
    if (!matrix.weight_steps.empty()) matrix.weight_steps.resize(num_components);
}

}  // namespace

void expect_shape(const ContainerReader& reader, const Section& section, uint32_t rows,
                  uint32_t columns) {
    const auto& shape = section.spec.shape;
    if (shape[0] != 1 || shape[1] != rows || shape[2] != columns) {
        throw_bad_input("{}: {} x {} x {} values, expected {} x {}", reader.label(section),
                        shape[0], shape[1], shape[2], rows, columns);
    }
}

PlanePredictor read_predictor(const ContainerReader& reader, const Topology& topology) {
    const bool predicted =
        std::any_of(reader.sections().begin(), reader.sections().end(),
                    [](const Section& s) { return s.codec == SectionCodec::planes; });
    if (!predicted) return {};
    const uint64_t most =
        most_bytes_of_values(reader.file_size_bytes()) / PlanePredictor::kBytesAVertex;
    if (topology.num_vertices > most) {
        throw_bad_input("{}: {} vertices, expected at most {} in a file of {} bytes", reader.path(),
                        topology.num_vertices, most, reader.file_size_bytes());
    }
    return PlanePredictor(topology);
}

void read_matrix(const ContainerReader& reader, Attribute attribute,
                 const PlanePredictor& predictor, uint32_t num_there, LowRankMatrix& matrix) {
    const auto i = static_cast<size_t>(attribute);
    WorkspacePool pool;
    read_weights(reader, i, pool, matrix);
    read_singular_values(reader, i, matrix);

    // Every shape is checked before memory for all values is taken: together they are no larger
    // than what a file of this size may claim.
    std::vector<const Section*> sections{&require(reader, section::kMean[i])};
    for (uint32_t k = 0; k < matrix.num_components; ++k) {
        sections.push_back(&require(reader, section::kComponent[i], k));
    }
    bool integers = false;
    for (const Section* section : sections) {
        expect_shape(reader, *section, matrix.num_planes, matrix.num_points);
        const bool is = is_integer(precision_of(section->spec.type));
        if (section != sections[0] && is != integers) {
            throw_unsupported("{}: {}, where others are not", reader.label(*section),
                              scalar_name(section->spec.type));
        }
        integers = is;
    }
    // The first component has the most bits.
    matrix.precision =
        precision_of(sections.size() > 1 ? sections[1]->spec.type : sections[0]->spec.type);
    if (integers) matrix.steps = read_steps(reader, section::kSteps[i], matrix.num_planes);
    if (num_there < matrix.num_components) keep_components(num_there, matrix);
    sections.resize(1 + matrix.num_components);
    std::vector<StoredValues> values = read_values(reader, sections, predictor, pool);
    matrix.mean = std::move(values[0]);
    matrix.components.assign(std::make_move_iterator(values.begin() + 1),
                             std::make_move_iterator(values.end()));
}

void read_clusters(const ContainerReader& reader, const PlanePredictor& predictor,
                   uint32_t num_vertices, VertexClusters& clusters) {
    WorkspacePool pool;
    const Section& numbers = reader.require(section::kClusters, ScalarType::i16);
    expect_shape(reader, numbers, 1, num_vertices);
    const StoredValues cluster = read_values(reader, numbers, predictor, pool);
    clusters.cluster.resize(num_vertices);
    cluster.for_each(0, num_vertices, [&](size_t v, float number) {
        if (!(number >= 0.0f && number < static_cast<float>(clusters.num_clusters))) {
            throw_bad_input("{}: vertex {}: cluster {}, expected 0 to {}", reader.label(numbers), v,
                            number, clusters.num_clusters - 1);
        }
        clusters.cluster[v] = static_cast<uint32_t>(number);
    });
    const Section& scales = reader.require(section::kClusterScales, ScalarType::f32);
    expect_shape(reader, scales, clusters.num_clusters, clusters.rows_per_cluster());
    clusters.scales = reader.read_f32(scales);
    check_finite(reader, section::kClusterScales, clusters.scales);
    std::vector<const Section*> sections;
    for (uint32_t j = 0; j < clusters.num_components; ++j) {
        sections.push_back(&require(reader, section::kClusterCoefficients, j));
        expect_shape(reader, *sections.back(), 1, num_vertices);
    }
    clusters.coefficients = read_values(reader, sections, predictor, pool);
}

StillPlanes read_still_planes(const ContainerReader& reader, Tag values, Tag steps,
                              uint32_t num_planes, uint32_t num_points,
                              const PlanePredictor& predictor) {
    const Section& section = require(reader, values);
    expect_shape(reader, section, num_planes, num_points);
    WorkspacePool pool;
    StillPlanes planes;
    if (is_integer(precision_of(section.spec.type))) {
        planes.steps = read_steps(reader, steps, num_planes);
    }
    planes.values = read_values(reader, section, predictor, pool);
    return planes;
}

}  // namespace paim
