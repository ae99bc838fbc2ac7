// Writes .paim files: floats uncompressed, all others packed.
#include <algorithm>
#include <utility>

#include "paim/base/check.h"
#include "paim/base/half.h"
#include "paim/format/container/root_numbers.h"
#include "paim/format/container/sections.h"
#include "paim/format/container/texture_section_writer.h"
#include "paim/format/paim/packed_file.h"
#include "paim/format/paim/paim_metadata.h"
#include "paim/format/paim/paim_write.h"

namespace paim {

namespace {

// The type of a row of floats in a file that is not packed.
struct PlainType {
    ScalarType operator()(Topology*) const { return ScalarType::u32; }
    ScalarType operator()(const SingularValues&) const { return ScalarType::f64; }
    ScalarType operator()(RootMotion*) const { return ScalarType::f64; }
    ScalarType operator()(const VertexNumbers&) const { return ScalarType::u32; }
    ScalarType operator()(const TextureValues& row) const { return row.type; }
    ScalarType operator()(const MatrixValues& row) const {
        return row.is_component && row.matrix->precision == Precision::f16 ? ScalarType::f16
                                                                           : ScalarType::f32;
    }
    template <typename Row>
    ScalarType operator()(const Row&) const {
        return ScalarType::f32;
    }
};

// Writes a row of floats.
struct PlainValues {
    ContainerWriter& writer;
    size_t section;
    uint32_t index;

    void operator()(const Topology* row) const {
        writer.append(section, std::span<const Triangle>(row->triangles));
    }
    void operator()(const Albedo* row) const {
        writer.append(section, std::span<const Vec3f>(row->values));
    }
    void operator()(const SingularValues& row) const {
        writer.append(section, std::span<const double>(row.matrix->singular_values));
    }
    void operator()(const Weights& row) const { floats(row.matrix->weights); }
    void operator()(const WeightSteps& row) const { floats(row.matrix->weight_steps); }
    void operator()(const Steps& row) const { floats(row.matrix->steps); }
    void operator()(const MatrixValues& row) const { floats(row.values->floats()); }
    void operator()(const StoredValues* row) const { floats(row->floats()); }
    void operator()(const std::vector<float>* row) const { floats(*row); }
    void operator()(const RootMotion* motion) const {
        const std::vector<double> numbers = root_numbers(*motion);
        writer.append(section, std::span<const double>(numbers));
    }
    void operator()(const VertexNumbers& row) const {
        writer.append(section, std::span<const uint32_t>(*row.values));
    }
    void operator()(const TextureValues& row) const {
        const std::vector<uint8_t> bytes =
            texture_bytes(row.mesh->texture, row.mesh->topology, row.piece, index);
        writer.append(section, bytes.data(), bytes.size());
    }
    void operator()(const SmallNumbers&) const { PAIM_CHECK(!"integers are packed"); }

  private:
    void floats(const std::vector<float>& values) const {
        writer.append(section, std::span<const float>(values));
    }
};

}  // namespace

// The sections of a file of floats, and those of them that are given in pieces.
struct PaimWriter::Layout {
    std::string metadata;
    std::vector<TableRow> table;  // row j is section 1 + j
    std::vector<SectionPlan> plans;
    struct Places {  // of the sections of an attribute
        size_t mean = 0;
        std::vector<size_t> components;
    };
    std::vector<Places> places;  // of CodedMesh::attributes()

    explicit Layout(const Asset& asset) : metadata(paim_metadata(asset)) {
        plans.push_back(SectionSpec{
            section::kMetadata, ScalarType::u8, 0, {1, 1, static_cast<uint32_t>(metadata.size())}});
        for (TableRow& row : section_table(asset)) {
            if (row.is_present()) table.push_back(std::move(row));
        }
        std::vector<const LowRank*> matrices;
        for (const Attribute which : asset.moving().attributes()) {
            matrices.push_back(&asset.moving().attribute(which));
            places.emplace_back().components.resize(matrices.back()->num_components);
        }
        for (const TableRow& row : table) {
            if (const auto* values = std::get_if<MatrixValues>(&row.values)) {
                for (size_t i = 0; i < matrices.size(); ++i) {
                    if (values->matrix != matrices[i]) continue;
                    (values->is_component ? places[i].components[row.index] : places[i].mean) =
                        plans.size();
                }
            }
            plans.push_back(SectionSpec{row.tag,
                                        std::visit(PlainType(), row.values),
                                        row.index,
                                        {1, row.shape[0], row.shape[1]}});
        }
    }
};

uint64_t paim_size_bytes(const Asset& asset) {
    if (needs_packing(asset)) return PackedFile(asset).size_bytes();
    return container_size_bytes(PaimWriter::section_plans(asset));
}

std::vector<SectionPlan> PaimWriter::section_plans(const Asset& asset) {
    return Layout(asset).plans;
}

PaimWriter::PaimWriter(const std::filesystem::path& path, const Asset& asset)
    : PaimWriter(path, asset, Layout(asset)) {}

PaimWriter::PaimWriter(const std::filesystem::path& path, const Asset& asset, Layout layout)
    : path_(path.string()),
      attributes_(asset.moving().attributes()),
      limits_(asset.moving()),
      writer_(path, section::kKindAnimation, layout.plans) {
    for (size_t i = 0; i < attributes_.size(); ++i) {
        const LowRank& matrix = asset.moving().attribute(attributes_[i]);
        streamed_.push_back({matrix.precision, layout.places[i].mean,
                             std::move(layout.places[i].components), StreamedMagnitudes(matrix)});
    }
    for (size_t part = 1; part < asset.parts.size(); ++part) {
        check_magnitudes(asset.parts[part], path_ + ": ", kScaleDown);
    }
    writer_.append(0, std::span<const char>(layout.metadata));
    for (size_t j = 0; j < layout.table.size(); ++j) {
        const TableRow& row = layout.table[j];
        // Those of the moving part are given in pieces.
        if (row.part == 0 && std::holds_alternative<MatrixValues>(row.values)) continue;
        std::visit(PlainValues{writer_, 1 + j, row.index}, row.values);
    }
}

void PaimWriter::append_rows(Attribute attribute, std::span<const float> mean,
                             std::span<const std::span<const float>> components) {
    const auto found = std::find(attributes_.begin(), attributes_.end(), attribute);
    PAIM_CHECK(found != attributes_.end());
    Streamed& to = streamed_[static_cast<size_t>(found - attributes_.begin())];
    PAIM_CHECK_EQ(components.size(), to.component_sections.size());
    writer_.append(to.mean_section, mean);
    for (size_t k = 0; k < components.size(); ++k) {
        append(to.component_sections[k], components[k], to.precision);
    }
    to.magnitudes.add(mean, components);
}

void PaimWriter::append(size_t section, std::span<const float> rows, Precision precision) {
    if (precision == Precision::f32) {
        writer_.append(section, rows);
        return;
    }
    std::vector<uint16_t> halves(rows.size());
    std::transform(rows.begin(), rows.end(), halves.begin(), to_half);
    writer_.append(section, std::span<const uint16_t>(halves));
}

void PaimWriter::commit() {
    for (size_t i = 0; i < attributes_.size(); ++i) {
        limits_.check(attributes_[i], streamed_[i].magnitudes.bounds(), path_ + ": ", kScaleDown);
    }
    writer_.commit();
}

void write_paim(const std::filesystem::path& path, const Asset& asset) {
    if (needs_packing(asset)) {
        PackedFile(asset).write(path);
        return;
    }
    PaimWriter writer(path, asset);
    for (const Attribute attribute : asset.moving().attributes()) {
        const LowRank& matrix = asset.moving().attribute(attribute);
        PAIM_CHECK_EQ(matrix.mean.size(), matrix.num_rows());
        PAIM_CHECK_EQ(matrix.components.size(), size_t{matrix.num_components});
        std::vector<std::span<const float>> components;
        for (const StoredValues& component : matrix.components) {
            components.emplace_back(component.floats());
        }
        writer.append_rows(attribute, matrix.mean.floats(), components);
    }
    writer.commit();
}

}  // namespace paim
