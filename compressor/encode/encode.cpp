// A .bake directory becomes a .paim file.
// Based on: Cardoso and Kry, Error Analysis of Precomputed Radiance Transfer for Deforming Geometry, 2012
#include "compressor/encode/encode.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>

#include "compressor/encode/bake_rows.h"
#include "compressor/encode/playable_scenery.h"
#include "compressor/encode/principal_components.h"
#include "paim/base/file.h"
#include "paim/format/paim_file.h"
#include "paim/metrics/spectrum.h"

namespace paim {

namespace {

// Everything about a part but its mean and components, which are streamed later.
LowRankMatrix start_matrix(const BakeReader& bake, const RowSource& rows,
                           const PrincipalComponents& components, const ComponentChoice& choice,
                           double automatic_error, const EncodeOptions& options) {
    LowRankMatrix matrix;
    matrix.num_vertices = bake.identity().num_vertices;
    matrix.num_planes = static_cast<uint32_t>(rows.num_rows() / matrix.num_vertices);
    matrix.num_poses = bake.num_poses();
    matrix.precision = options.precision;
    matrix.singular_values = components.singular_values;
    matrix.num_components =
        choose_components(choice, matrix.singular_values, components.rank(), automatic_error);
    matrix.weights = component_weights(components, matrix.num_components, rows.num_rows());
    return matrix;
}

void stream(PaimWriter& writer, Part part, const RowSource& rows,
            const PrincipalComponents& components, uint32_t num_components) {
    for_each_encoded_block(rows, components, num_components, [&](const EncodedRows& block) {
        writer.append_mean(part, block.mean);
        for (uint32_t k = 0; k < num_components; ++k) {
            writer.append_component({part, k}, block.components[k]);
        }
    });
}

std::string provenance(const BakeReader& bake) {
    const BakeIdentity& identity = bake.identity();
    nlohmann::ordered_json json;
    json["bake_bands"] = identity.layout.bands;
    json["rays"] = identity.rays;
    json["seed"] = fmt::format("{:016x}", identity.seed);
    json["normals"] = identity.normals;
    if (identity.bounces > 0) json["bounces"] = identity.bounces;
    json["bake_noise"] = bake.total_statistics().relative_noise();
    return json.dump();
}

}  // namespace

uint32_t choose_components(const ComponentChoice& choice, std::span<const double> singular_values,
                           uint32_t rank, double automatic_energy_error) {
    switch (choice.kind) {
        case ComponentChoice::Kind::all:
            return rank;
        case ComponentChoice::Kind::number:
            return std::min(choice.number, rank);
        case ComponentChoice::Kind::automatic:
            break;
    }
    uint32_t k = 0;
    while (k < rank && energy_error(singular_values, k) >= automatic_energy_error) ++k;
    return k;
}

uint64_t num_rows_to_read(const BakeReader& bake, const EncodeOptions& options) {
    const uint32_t bands = std::min(options.bands, bake.identity().layout.bands);
    return 2 * (GeometryRows(bake).num_rows() + TransferRows(bake, bands).num_rows());
}

EncodeSummary encode(const BakeReader& bake, const EncodeOptions& options,
                     const std::filesystem::path& output,
                     const std::function<void(uint64_t)>& on_rows) {
    remove_abandoned_files(std::filesystem::absolute(output).parent_path(),
                           output.filename().string() + ".");
    Model model;
    model.topology = bake.topology();
    model.albedo = bake.albedo();
    model.layout = bake.identity().layout;
    model.layout.bands = std::min(options.bands, model.layout.bands);
    model.frames_per_second = options.frames_per_second;
    model.name = options.name;
    model.provenance_json = provenance(bake);
    model.scenery = playable_scenery(bake, model.layout.bands);

    const GeometryRows baked_geometry(bake);
    const TransferRows baked_transfer(bake, model.layout.bands);
    const ReportingRows geometry_rows(baked_geometry, on_rows);
    const ReportingRows transfer_rows(baked_transfer, on_rows);
    const PrincipalComponents geometry = principal_components(geometry_rows);
    const PrincipalComponents transfer = principal_components(transfer_rows);
    model.geometry = start_matrix(bake, geometry_rows, geometry, options.geometry,
                                  options.automatic_geometry_error, options);
    model.transfer = start_matrix(bake, transfer_rows, transfer, options.transfer,
                                  options.automatic_transfer_error, options);

    PaimWriter writer(output, model);
    stream(writer, Part::geometry, geometry_rows, geometry, model.geometry.num_components);
    stream(writer, Part::transfer, transfer_rows, transfer, model.transfer.num_components);
    writer.commit();

    EncodeSummary summary;
    summary.geometry_components = model.geometry.num_components;
    summary.transfer_components = model.transfer.num_components;
    summary.geometry_rank = geometry.rank();
    summary.transfer_rank = transfer.rank();
    summary.bands = model.layout.bands;
    summary.geometry_theory_error =
        theory_error(geometry.singular_values, summary.geometry_components);
    summary.transfer_theory_error =
        theory_error(transfer.singular_values, summary.transfer_components);
    summary.geometry_energy_error =
        energy_error(geometry.singular_values, summary.geometry_components);
    summary.transfer_energy_error =
        energy_error(transfer.singular_values, summary.transfer_components);
    summary.size_bytes = paim_size_bytes(model);
    return summary;
}

}  // namespace paim
