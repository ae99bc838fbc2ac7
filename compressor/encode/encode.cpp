// Encodes a .bake directory as a .paim file, row by row.
// Based on: Cardoso and Kry, Error Analysis of Precomputed Radiance Transfer for Deforming
// Geometry,
//           2012
#include "compressor/encode/encode.h"

#include <nlohmann/json.hpp>

#include <algorithm>

#include "compressor/encode/data/bake_rows.h"
#include "compressor/encode/data/provenance.h"
#include "compressor/encode/data/still_part.h"
#include "compressor/encode/memory/measuring_memory.h"
#include "compressor/encode/memory/memory_plan.h"
#include "compressor/encode/noise/rank_selection.h"
#include "compressor/encode/noise/shrinkage.h"
#include "compressor/encode/quantise/exceptions.h"
#include "compressor/encode/state_errors.h"
#include "compressor/encode/svd/motion_groups.h"
#include "compressor/encode/svd/projected_blocks.h"
#include "compressor/encode/svd/vertex_motion.h"
#include "paim/base/file.h"
#include "paim/base/json_text.h"
#include "paim/codec/codecs.h"
#include "paim/format/bake/baked_part.h"
#include "paim/format/paim/paim_write.h"
#include "paim/mesh/face_vertices.h"
#include "paim/mesh/origin.h"
#include "paim/metrics/singular_value_error.h"

namespace paim {

namespace {

// The asset without positions and transfer of the part that moves.
Asset asset_shell(const BakeReader& bake, const EncodeOptions& options) {
    Asset asset;
    asset.origin = bake.identity().origin;
    asset.frames_per_second = options.frames_per_second;
    asset.name = options.name;
    CodedMesh mesh;
    mesh.topology = bake.topology();
    mesh.albedo = bake.albedo();
    mesh.texture = bake.texture();
    mesh.layout = bake.identity().layout.with_bands(options.bands);
    mesh.root_motion = bake.identity().root_motion;
    mesh.num_following = bake.identity().num_following;
    auto still = still_part(bake, mesh.layout.in_bands);
    asset.moving() = std::move(mesh);
    if (still) asset.parts.push_back(std::move(*still));
    if (!options.textures) {
        for (CodedMesh& part : asset.parts) part.texture = {};
    }
    return asset;
}

// A part without its mean and components, which are streamed later.
LowRank start_matrix(const BakeReader& bake, const RowSource& rows,
                     const PrincipalComponents& components, uint32_t num_components,
                     const EncodeOptions& options) {
    LowRank matrix;
    matrix.num_points = bake.identity().num_vertices;
    matrix.num_planes = static_cast<uint32_t>(rows.num_rows() / matrix.num_points);
    matrix.num_poses = bake.num_poses();
    matrix.precision = options.precision;
    matrix.singular_values = components.singular_values;
    matrix.num_components = num_components;
    matrix.weights = component_weights(components, matrix.num_components, rows.num_rows());
    return matrix;
}

// Called for each block of rows, in order, before it is written.
using OnBlock = std::function<void(uint64_t first, EncodedRows& block)>;

void stream(PaimWriter& writer, Attribute attribute, const RowSource& rows,
            const PrincipalComponents& components, uint32_t num_components, uint32_t num_in_flight,
            const OnBlock& on_block) {
    uint64_t first = 0;
    const auto append = [&](EncodedRows& block) {
        on_block(first, block);
        first += block.mean.size();
        const std::vector<std::span<const float>> of_components(block.components.begin(),
                                                                block.components.end());
        writer.append_rows(attribute, block.mean, of_components);
        block = {};
    };
    for_each_encoded_block(rows, components, num_components, append, num_in_flight);
}

// Adds rows of the exceptions behind those of the components.
OnBlock append_exception_rows(const std::vector<FloatException>& exceptions,
                              const PositionOutliers& outliers, uint32_t num_vertices) {
    return [&, num_vertices](uint64_t first, EncodedRows& block) {
        for (const FloatException& exception : exceptions) {
            std::vector<float>& rows = block.components.emplace_back(block.mean.size(), 0.0f);
            exception.add_rows(outliers, num_vertices, first, rows);
        }
    };
}

// The fewest components whose rest is an RMS distance of at most the rounding of coordinates
// (mesh/origin.h). A rigid body has no others.
uint32_t components_above_rounding(const PrincipalComponents& geometry, double diagonal,
                                   double num_positions) {
    const double rounding = kCoordinateRounding * diagonal;
    const double most = rounding * rounding * num_positions;
    return components_for(geometry.rank(), most, [&](uint32_t k) {
        return geometry.singular_values[k] * geometry.singular_values[k];
    });
}

// How many components of the geometry to keep.
uint32_t choose_geometry(const BakeReader& bake, const EncodeOptions& options,
                         const PositionOutliers& outliers, const RowSource& rows,
                         const PrincipalComponents& geometry) {
    uint32_t of_all = choose_components(options.geometry, geometry.singular_values, geometry.rank(),
                                        options.automatic_geometry_error);
    if (options.geometry.kind != ComponentChoice::Kind::automatic) return of_all;
    const std::vector<uint32_t> vertices = face_vertices(bake.topology());
    const double diagonal = pose_diagonals(bake, outliers, vertices).median;
    const double num_positions = static_cast<double>(vertices.size()) * bake.num_poses();
    of_all = std::min(of_all, components_above_rounding(geometry, diagonal, num_positions));
    MotionLimits limits;
    limits.invisible = kInvisibleMotion * diagonal;
    limits.group = motion_groups(bake.topology(), rows.silent());
    return std::max(of_all, components_for_motion(rows.silent(), geometry, vertices, limits));
}

// Sum of squares of the bake's transfer in the bands of the layout, over all rows and poses.
double transfer_energy(const BakeReader& bake, const PoseStatistics& total,
                       const TransferLayout& layout) {
    const std::vector<double>& rms = total.transfer_rms;
    double energy = 0.0;
    for (size_t l = 0; l < layout.in_bands; ++l) {
        energy += static_cast<double>((2 * l + 1) * layout.channels * layout.num_outgoing()) *
                  rms[l] * rms[l];
    }
    return energy * bake.identity().num_vertices * bake.num_poses();
}

// All but the size and what is measured.
EncodeSummary summarise(const BakeReader& bake, const EncodeOptions& options,
                        const Decomposition& parts, uint32_t geometry_components,
                        const Shrinkage& shrinkage, const PoseStatistics& total) {
    const auto& [geometry, transfer, noise] = parts;
    EncodeSummary summary;
    summary.geometry_components = geometry_components;
    summary.transfer_components =
        choose_components(options.transfer, noise, options.automatic_transfer_error);
    summary.geometry_rank = geometry.rank();
    summary.transfer_rank = transfer.rank();
    summary.bands = noise.layout.in_bands;
    summary.geometry_theory_error =
        theory_error(geometry.singular_values, summary.geometry_components);
    summary.transfer_theory_error =
        theory_error(transfer.singular_values, summary.transfer_components);
    summary.geometry_energy_error =
        energy_error(geometry.singular_values, summary.geometry_components);
    summary.transfer_energy_error =
        energy_error(transfer.singular_values, summary.transfer_components);
    summary.transfer_above_noise = noise.num_above_noise;
    summary.transfer_signal_error = signal_error(noise, summary.transfer_components);
    summary.shrunk = options.noise == NoiseTreatment::shrink &&
                     options.transfer.kind != ComponentChoice::Kind::all;
    const EncodedError error = summary.shrunk
                                   ? shrinkage.expected_error(summary.transfer_components)
                                   : expected_error_unshrunk(noise, summary.transfer_components);
    if (const double energy = transfer_energy(bake, total, noise.layout); energy > 0.0) {
        summary.expected_truncation_error = std::sqrt(error.truncation / energy);
        summary.expected_noise_error = std::sqrt(error.noise / energy);
    }
    return summary;
}

std::string provenance(const BakeIdentity& identity, const PoseStatistics& total,
                       const EncodeSummary& summary) {
    auto json = nlohmann::ordered_json::parse(bake_provenance(identity, total));
    json["noise"] = summary.shrunk ? "shrink" : "keep";
    json["expected_transfer_error"] = summary.expected_error();
    return json_text(json);
}

// Returns everything but what is measured. Its own memory is free again when it returns.
// known  the components of these bands, if they were found before; else null
EncodeSummary encode_unmeasured(const BakeReader& bake, const EncodeOptions& options,
                                const Decomposition* known, const std::filesystem::path& output,
                                const std::function<void(uint64_t)>& on_rows) {
    const PositionOutliers outliers = find_outliers(BakedPart(bake, 0));
    const EncodeSize size = with_outliers(encode_size(bake, options), outliers);
    const uint32_t in_flight =
        choose_num_in_flight(size, options.memory_bytes, bake.directory().string());
    Asset asset = asset_shell(bake, options);
    CodedMesh& mesh = asset.moving();
    const GeometryRows baked_geometry(bake, outliers);
    const TransferRows baked_transfer(bake, mesh.layout.in_bands);
    const TransferRows baked_noise(bake, mesh.layout.in_bands, TransferRows::Content::noise);
    const ReportingRows geometry_rows(baked_geometry, on_rows);
    const ReportingRows transfer_rows(baked_transfer, on_rows);
    const ReportingRows noise_rows(baked_noise, on_rows);
    std::optional<Decomposition> found;
    if (known == nullptr) {
        found = decompose(geometry_rows, transfer_rows, noise_rows, mesh.layout, in_flight);
    }
    const Decomposition& parts = known != nullptr ? *known : *found;
    const Shrinkage shrinkage(parts.noise);
    const PoseStatistics total = bake.total_statistics();
    const uint32_t num_usual =
        choose_geometry(bake, options, outliers, geometry_rows, parts.geometry);
    EncodeSummary summary = summarise(bake, options, parts, num_usual, shrinkage, total);
    summary.outliers = outliers;
    asset.provenance_json = provenance(bake.identity(), total, summary);
    mesh.positions = start_matrix(bake, geometry_rows, parts.geometry, num_usual, options);
    const std::vector<FloatException> exceptions = float_exceptions(outliers);
    append_weights(exceptions, mesh.positions);
    mesh.transfer = plain_transfer(
        start_matrix(bake, transfer_rows, parts.transfer, summary.transfer_components, options));
    summary.size_bytes = paim_size_bytes(asset);
    if (options.measure) {
        check_measuring_memory(summary.size_bytes, mesh.topology.num_vertices, asset.num_poses(),
                               size.still_mesh_bytes + size.texture_bytes, options.memory_bytes,
                               output.string());
    }
    PaimWriter writer(output, asset);
    stream(writer, Attribute::geometry, geometry_rows, parts.geometry, num_usual, in_flight,
           append_exception_rows(exceptions, outliers, mesh.topology.num_vertices));
    stream(writer, Attribute::transfer, transfer_rows, parts.transfer, summary.transfer_components,
           in_flight, [&](uint64_t first, EncodedRows& block) {
               if (summary.shrunk) shrinkage.apply(first, block.components);
           });
    writer.commit();
    return summary;
}

}  // namespace

uint64_t num_rows_to_read(const BakeReader& bake, const EncodeOptions& options) {
    const uint32_t bands = std::min(options.bands, bake.identity().layout.in_bands);
    return 2 * uint64_t{3} * bake.identity().num_vertices +
           4 * TransferRows(bake, bands).num_rows();
}

void check_memory(const BakeReader& bake, const EncodeOptions& options) {
    choose_num_in_flight(encode_size(bake, options), options.memory_bytes,
                         bake.directory().string());
}

namespace {

EncodeSummary encode(const BakeReader& bake, const EncodeOptions& options,
                     const Decomposition* known, const std::filesystem::path& output,
                     const std::function<void(uint64_t)>& on_rows) {
    remove_abandoned_versions(output);
    EncodeSummary summary = encode_unmeasured(bake, options, known, output, on_rows);
    if (!options.measure) return summary;
    summary.measured = state_errors(output, bake, BandPower::flat(bake.identity().layout.in_bands),
                                    options.memory_bytes);
    summary.size_bytes = std::filesystem::file_size(output);
    return summary;
}

}  // namespace

EncodeSummary encode(const BakeReader& bake, const EncodeOptions& options,
                     const std::filesystem::path& output,
                     const std::function<void(uint64_t)>& on_rows) {
    return encode(bake, options, nullptr, output, on_rows);
}

EncodeSummary encode(const BakeReader& bake, const EncodeOptions& options,
                     const Decomposition& parts, const std::filesystem::path& output) {
    return encode(bake, options, &parts, output, {});
}

}  // namespace paim
