// Builds a .paim with compressed sections in memory.
#include "paim/format/paim/packed_file.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <memory>
#include <utility>

#include "paim/base/check.h"
#include "paim/base/error.h"
#include "paim/base/half.h"
#include "paim/base/parallel.h"
#include "paim/codec/surface_smoothing.h"
#include "paim/format/container/root_numbers.h"
#include "paim/format/container/sections.h"
#include "paim/format/container/texture_section_writer.h"
#include "paim/format/pack/index_encoder.h"
#include "paim/format/pack/plane_encoder.h"
#include "paim/format/paim/paim_metadata.h"
#include "paim/format/paim/row_predictors.h"
#include "paim/format/paim/section_table.h"
#include "paim/format/paim/value_limits.h"

namespace paim {

namespace {

using Bytes = std::vector<uint8_t>;

// A section before it is compressed.
struct Task {
    SectionSpec spec;
    SectionCodec codec;
    std::function<Bytes()> compress;
};

template <typename T>
Bytes as_bytes(std::span<const T> values) {
    const auto* first = reinterpret_cast<const uint8_t*>(values.data());
    return {first, first + values.size_bytes()};
}

// Weights [K][P] as integer multiples of their steps. They are such multiples exactly.
StoredValues weight_integers(const LowRank& matrix) {
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

// Makes a task from each kind of row.
class Packer {
  public:
    Packer(const TableRow& row, const PlanePredictor& predictor, Effort effort)
        : row_(row), predictor_(predictor), effort_(effort) {}

    Task operator()(const Topology* topology) const {
        return {spec(ScalarType::u32), SectionCodec::indices,
                [topology] { return encode_triangles(*topology); }};
    }
    Task operator()(const Albedo* albedo) const {
        return zstd(ScalarType::f32, std::span<const Vec3f>(albedo->values));
    }
    Task operator()(const TextureValues& row) const {
        const auto bytes = [row, index = row_.index] {
            return texture_bytes(row.mesh->texture, row.mesh->topology, row.piece, index);
        };
        // Images are compressed already.
        if (row.piece == TexturePiece::image) return {spec(row.type), SectionCodec::none, bytes};
        return {spec(row.type), SectionCodec::zstd, [bytes] { return zstd_compress(bytes()); }};
    }
    Task operator()(const SingularValues& row) const {
        return {spec(ScalarType::f32), SectionCodec::zstd, [matrix = row.matrix] {
                    std::vector<float> rounded(matrix->singular_values.begin(),
                                               matrix->singular_values.end());
                    // Zero is the mark of exceptions (LowRank::num_usual_components()).
                    for (size_t j = 0; j < rounded.size(); ++j) {
                        if (matrix->singular_values[j] > 0.0 && rounded[j] == 0.0f) {
                            rounded[j] = std::numeric_limits<float>::denorm_min();
                        }
                    }
                    if (!rounded.empty() && std::isinf(rounded[0])) {
                        throw_bad_input(
                            "a singular value is {}, expected at most {}: scale the poses down",
                            matrix->singular_values[0], std::numeric_limits<float>::max());
                    }
                    return zstd_compress(as_bytes(std::span<const float>(rounded)));
                }};
    }
    Task operator()(const Weights& row) const {
        const LowRank& matrix = *row.matrix;
        if (matrix.weight_steps.empty() || matrix.num_components == 0) {
            return zstd(ScalarType::f32, std::span<const float>(matrix.weights));
        }
        return {spec(ScalarType::i16), SectionCodec::planes, [&matrix, &predictor = predictor_] {
                    return encode_planes(weight_integers(matrix), matrix.num_components, predictor);
                }};
    }
    Task operator()(const WeightSteps& row) const { return steps(row.matrix->weight_steps); }
    Task operator()(const Steps& row) const {
        std::vector<float> stored = row.matrix->steps;
        const auto bits = static_cast<int>(row.matrix->fraction_bits);
        for (float& step : stored) step = std::ldexp(step, bits);
        return steps(std::move(stored));
    }
    Task operator()(const MatrixValues& row) const {
        PAIM_CHECK(row.values != nullptr);
        // Floats of still parts are few and smooth enough to be worth compressing.
        const bool is_still = row.matrix->num_poses == 1 && row_.part > 0;
        if (is_still && row.values->holds_floats()) return floats(row.values->floats());
        if (row.matrix->fraction_bits > 0) {
            return integers(std::make_shared<const StoredValues>(
                stored_integers(*row.values, row.matrix->fraction_bits)));
        }
        const Precision precision = row.is_component ? row.matrix->precision : Precision::f32;
        return values(*row.values, precision);
    }
    Task operator()(const StoredValues* row) const { return values(*row, Precision::f32); }
    Task operator()(const SmallNumbers& row) const {
        return {spec(ScalarType::i16), SectionCodec::planes,
                [numbers = row.values, num_rows = row_.shape[0], &predictor = predictor_,
                 effort = effort_] {
                    const StoredValues integers =
                        std::vector<int16_t>(numbers->begin(), numbers->end());
                    return encode_planes(integers, num_rows, predictor, effort);
                }};
    }
    Task operator()(const VertexNumbers& row) const {
        return zstd(ScalarType::u32, std::span<const uint32_t>(*row.values));
    }
    Task operator()(const std::vector<float>* row) const { return floats(*row); }
    Task operator()(const RootMotion* motion) const {
        return {spec(ScalarType::f64), SectionCodec::zstd, [motion] {
                    const std::vector<double> numbers = root_numbers(*motion);
                    return zstd_compress(as_bytes(std::span(numbers)));
                }};
    }

  private:
    SectionSpec spec(ScalarType type) const {
        return {row_.tag, type, row_.index, {1, row_.shape[0], row_.shape[1]}};
    }
    template <typename T>
    Task zstd(ScalarType type, std::span<const T> values) const {
        const SectionSpec spec = this->spec(type);
        PAIM_CHECK_EQ(values.size_bytes(), spec.size_bytes());
        return {spec, SectionCodec::zstd, [values] { return zstd_compress(as_bytes(values)); }};
    }
    Task floats(const std::vector<float>& values) const {
        return zstd(ScalarType::f32, std::span<const float>(values));
    }
    Task steps(std::vector<float> values) const {
        for (const float step : values) {
            if (!(step <= kMaxStep)) {
                throw_bad_input(
                    "a step of integers is {}, expected at most {}: scale the poses down, or use "
                    "--precision f32",
                    step, kMaxStep);
            }
        }
        const SectionSpec spec = this->spec(ScalarType::f32);
        PAIM_CHECK_EQ(values.size(), spec.num_values());
        return {spec, SectionCodec::zstd, [values = std::move(values)] {
                    return zstd_compress(as_bytes(std::span<const float>(values)));
                }};
    }
    Task integers(std::shared_ptr<const StoredValues> values) const {
        const SectionSpec spec = this->spec(values->holds_i8() ? ScalarType::i8 : ScalarType::i16);
        PAIM_CHECK_EQ(values->size(), spec.num_values());
        return {spec, SectionCodec::planes,
                [values = std::move(values), num_rows = row_.shape[0], &predictor = predictor_,
                 effort = effort_] { return encode_planes(*values, num_rows, predictor, effort); }};
    }
    // Integers are predicted, floats stored as they are.
    Task values(const StoredValues& values, Precision precision) const {
        SectionSpec spec = this->spec(ScalarType::f32);
        PAIM_CHECK_EQ(values.size(), spec.num_values());
        if (!values.holds_floats()) {
            // The asset owns them, and outlives the task.
            return integers({std::shared_ptr<void>(), &values});
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

    const TableRow& row_;
    const PlanePredictor& predictor_;
    const Effort effort_;
};

bool holds_integers(const TableRow& row) {
    if (const auto* values = std::get_if<MatrixValues>(&row.values)) {
        return values->values != nullptr && !values->values->holds_floats();
    }
    if (const auto* values = std::get_if<StoredValues*>(&row.values)) {
        return !(*values)->holds_floats();
    }
    return std::holds_alternative<SmallNumbers>(row.values) ||
           (std::holds_alternative<WeightSteps>(row.values) && row.is_present());
}

}  // namespace

bool needs_packing(const Asset& asset) {
    const CodedMesh& moving = asset.moving();
    if (moving.transfer->always_packed()) return true;
    if (moving.gloss && moving.gloss->transfer->always_packed()) return true;
    const std::vector<TableRow> table = section_table(asset);
    return std::any_of(table.begin(), table.end(), holds_integers);
}

PackedFile::PackedFile(const Asset& asset, Effort effort) {
    for (const CodedMesh& mesh : asset.parts) check_magnitudes(mesh, {}, kScaleDown);
    const std::string metadata = paim_metadata(asset);
    const std::vector<TableRow> table = section_table(asset);
    const RowPredictors predictors(asset);
    std::vector<Task> tasks;
    tasks.push_back(
        {{section::kMetadata, ScalarType::u8, 0, {1, 1, static_cast<uint32_t>(metadata.size())}},
         SectionCodec::zstd,
         [&metadata] { return zstd_compress(as_bytes(std::span<const char>(metadata))); }});
    for (const TableRow& row : table) {
        if (!row.is_present()) continue;
        tasks.push_back(std::visit(Packer(row, predictors.of(row), effort), row.values));
    }

    bytes_.resize(tasks.size());
    parallel_for(tasks.size(), 1,
                 [&](size_t task, size_t) { bytes_[task] = tasks[task].compress(); });
    uint64_t value_bytes = 0;
    for (size_t j = 0; j < tasks.size(); ++j) {
        value_bytes += tasks[j].spec.size_bytes();
        plans_.emplace_back(tasks[j].spec, tasks[j].codec, bytes_[j].size());
    }
    check_expansion(asset, value_bytes);
}

void PackedFile::check_expansion(const Asset& asset, uint64_t value_bytes) const {
    const uint64_t readable = most_bytes_of_values(size_bytes());
    uint32_t most_vertices = 0;
    for (const CodedMesh& mesh : asset.parts) {
        most_vertices = std::max(most_vertices, mesh.topology.num_vertices);
    }
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
