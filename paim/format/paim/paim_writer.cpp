// Writes .paim files.
#include <algorithm>
#include <utility>

#include "paim/base/check.h"
#include "paim/base/half.h"
#include "paim/format/container/mesh_section_writer.h"
#include "paim/format/container/sections.h"
#include "paim/format/paim/paim_file.h"
#include "paim/format/paim/paim_metadata.h"
#include "paim/format/paim/paim_packer.h"
#include "paim/format/paim/scenery_sections.h"

namespace paim {

namespace {

constexpr Attribute kAttributes[] = {Attribute::geometry, Attribute::transfer};

ScalarType scalar_type(Precision precision) {
    return precision == Precision::f16 ? ScalarType::f16 : ScalarType::f32;
}

}  // namespace

std::vector<ComponentId> component_order(const Model& model) {
    struct Ranked {
        ComponentId id;
        double share;
    };
    std::vector<Ranked> ranked;
    for (const Attribute attribute : kAttributes) {
        const LowRankMatrix& matrix = model.attribute(attribute);
        const double largest = matrix.singular_values.empty() ? 0.0 : matrix.singular_values[0];
        double energy = 0.0;  // relative to the largest value, which may be too big to square
        for (const double s : matrix.singular_values) energy += (s / largest) * (s / largest);
        for (uint32_t k = 0; k < matrix.num_components; ++k) {
            const double ratio =
                largest > 0.0 ? matrix.singular_values[matrix.singular_index(k)] / largest : 0.0;
            ranked.push_back({{attribute, k}, largest > 0.0 ? ratio * ratio / energy : 0.0});
        }
    }
    std::stable_sort(ranked.begin(), ranked.end(),
                     [](const Ranked& a, const Ranked& b) { return a.share > b.share; });
    std::vector<ComponentId> order(ranked.size());
    std::transform(ranked.begin(), ranked.end(), order.begin(),
                   [](const Ranked& r) { return r.id; });
    return order;
}

// Which section holds what.
struct PaimWriter::Index {
    std::string metadata;
    std::vector<SectionPlan> specs;
    size_t scenery;  // the first of its sections
    size_t spectrum[2], weights[2], mean[2];
    std::vector<size_t> component[2];

    explicit Index(const Model& model) : metadata(paim_metadata(model)) {
        add({section::kMetadata,
             ScalarType::u8,
             0,
             {1, 1, static_cast<uint32_t>(metadata.size())}});
        specs.push_back(triangles_spec(model.topology));
        specs.push_back(albedo_spec(model.albedo));
        scenery = specs.size();
        for (const SectionSpec& spec : scenery_specs(model.scenery, model.layout)) add(spec);
        for (const Attribute attribute : kAttributes) {
            const auto i = static_cast<size_t>(attribute);
            const LowRankMatrix& matrix = model.attribute(attribute);
            spectrum[i] = add({section::kSingularValues[i],
                               ScalarType::f64,
                               0,
                               {1, 1, static_cast<uint32_t>(matrix.singular_values.size())}});
            weights[i] = add({section::kWeights[i],
                              ScalarType::f32,
                              0,
                              {1, matrix.num_components, matrix.num_poses}});
        }
        for (const Attribute attribute : kAttributes) {
            const auto i = static_cast<size_t>(attribute);
            const LowRankMatrix& matrix = model.attribute(attribute);
            mean[i] = add(
                {section::kMean[i], ScalarType::f32, 0, {1, matrix.num_planes, matrix.num_points}});
            component[i].resize(matrix.num_components);
        }
        for (const auto& [attribute, k] : component_order(model)) {
            const auto i = static_cast<size_t>(attribute);
            const LowRankMatrix& matrix = model.attribute(attribute);
            component[i][k] = add({section::kComponent[i],
                                   scalar_type(matrix.precision),
                                   k,
                                   {1, matrix.num_planes, matrix.num_points}});
        }
    }

    size_t add(SectionSpec spec) {
        specs.push_back(spec);
        return specs.size() - 1;
    }
};

uint64_t paim_size_bytes(const Model& model) {
    if (needs_packing(model)) return PackedFile(model).size_bytes();
    return container_size_bytes(PaimWriter::section_plans(model));
}

std::vector<SectionPlan> PaimWriter::section_plans(const Model& model) {
    return Index(model).specs;
}

PaimWriter::PaimWriter(const std::filesystem::path& path, const Model& model)
    : PaimWriter(path, model, Index(model)) {}

PaimWriter::PaimWriter(const std::filesystem::path& path, const Model& model, Index index)
    : precision_{model.geometry.precision, model.transfer.precision},
      mean_section_{index.mean[0], index.mean[1]},
      component_section_{std::move(index.component[0]), std::move(index.component[1])},
      writer_(path, section::kKindAnimation, index.specs) {
    writer_.append(0, index.metadata.data(), index.metadata.size());
    append_mesh(writer_, 1, 2, model.topology, model.albedo);
    append_scenery(writer_, index.scenery, model.scenery);
    for (const Attribute attribute : kAttributes) {
        const auto i = static_cast<size_t>(attribute);
        const LowRankMatrix& matrix = model.attribute(attribute);
        writer_.append(index.spectrum[i], std::span(matrix.singular_values));
        writer_.append(index.weights[i], std::span(matrix.weights));
    }
}

void PaimWriter::append_mean(Attribute attribute, std::span<const float> rows) {
    writer_.append(mean_section_[static_cast<size_t>(attribute)], rows);
}

void PaimWriter::append_component(ComponentId id, std::span<const float> rows) {
    const auto i = static_cast<size_t>(id.attribute);
    const size_t section = component_section_[i][id.k];
    if (precision_[i] == Precision::f32) {
        writer_.append(section, rows);
        return;
    }
    std::vector<uint16_t> halves(rows.size());
    std::transform(rows.begin(), rows.end(), halves.begin(), to_half);
    writer_.append(section, std::span<const uint16_t>(halves));
}

void write_paim(const std::filesystem::path& path, const Model& model) {
    if (needs_packing(model)) {
        PackedFile(model).write(path);
        return;
    }
    PaimWriter writer(path, model);
    for (const Attribute attribute : kAttributes) {
        const LowRankMatrix& matrix = model.attribute(attribute);
        PAIM_CHECK_EQ(matrix.mean.size(), matrix.num_rows());
        PAIM_CHECK_EQ(matrix.components.size(), size_t{matrix.num_components});
        writer.append_mean(attribute, matrix.mean.floats());
        for (uint32_t k = 0; k < matrix.num_components; ++k) {
            writer.append_component({attribute, k}, matrix.components[k].floats());
        }
    }
    writer.commit();
}

}  // namespace paim
