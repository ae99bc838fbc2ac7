// A compressed animation, whatever its codec, against the bake it was made from.
#include "paim/metrics/model_error.h"

#include <limits>
#include <nlohmann/json.hpp>

#include "paim/base/error.h"
#include "paim/base/parallel.h"
#include "paim/codec/component_planes.h"
#include "paim/codec/pose_parts.h"
#include "paim/format/container/metadata.h"
#include "paim/metrics/pose_space.h"
#include "paim/metrics/vertex_match.h"

namespace paim {

using Eigen::Index;
using Eigen::MatrixXf;

namespace {

std::vector<uint32_t> check_same_animation(const Model& model, const BakeReader& bake) {
    const BakeIdentity& identity = bake.identity();
    const auto expect = [&](const char* what, uint64_t expected, uint64_t got) {
        if (expected == got) return;
        throw_bad_input("{}: expected a file made from this bake, with {} {}, got {}",
                        bake.directory().string(), expected, what, got);
    };
    expect("vertices", identity.num_vertices, model.topology.num_vertices);
    expect("poses", identity.num_poses(), model.num_poses());
    expect("vertices of scenery", bake.scenery() ? bake.scenery()->topology.num_vertices : 0,
           model.scenery.topology.num_vertices);
    std::vector<uint32_t> old_vertex =
        match_vertices(model.topology, model.vertex_order, bake.topology(),
                       bake.directory().string(), "triangles");
    if (model.layout.kind != identity.layout.kind || model.layout.bands > identity.layout.bands ||
        (model.layout.channels != 1 && model.layout.channels != identity.layout.channels)) {
        throw_bad_input(
            "{}: expected a file made from this bake, of {} bands and {} channels at most, got {} "
            "and {}",
            bake.directory().string(), identity.layout.bands, identity.layout.channels,
            model.layout.bands, model.layout.channels);
    }
    return old_vertex;
}

TransferError measure_transfer(const Model& model, const BakeReader& bake,
                               const BandPower& spectrum, const std::vector<uint32_t>& old_vertex) {
    const TransferLayout& layout = bake.identity().layout;
    const uint32_t num_vertices = bake.identity().num_vertices;
    const uint32_t num_poses = bake.num_poses();
    TransferErrorMeter meter(layout, num_vertices, num_poses, spectrum,
                             orthonormal_pose_space(model.transfer.weights, num_poses));
    MatrixXf baked(static_cast<Index>(num_vertices), static_cast<Index>(num_poses));
    MatrixXf noise = baked;
    for (uint32_t plane = 0; plane < layout.num_planes(); ++plane) {
        const uint64_t first = uint64_t{plane} * num_vertices;
        parallel_for(num_poses, 1, [&](size_t p, size_t) {
            const auto column = static_cast<Index>(p);
            const auto pose = static_cast<uint32_t>(p);
            bake.read_transfer_rows(pose, first, num_vertices, baked.col(column).data());
            bake.read_noise_rows(pose, first, num_vertices, noise.col(column).data());
            reorder_planes({baked.col(column).data(), num_vertices}, old_vertex);
            reorder_planes({noise.col(column).data(), num_vertices}, old_vertex);
        });
        const auto kept = plane_of_file(model.layout, layout, plane);
        meter.add(plane, baked, noise,
                  kept ? decode_plane(model, Attribute::transfer, *kept)
                       : MatrixXf::Zero(baked.rows(), baked.cols()));
    }
    return meter.result();
}

GeometryError measure_geometry(const Model& model, const BakeReader& bake,
                               const std::vector<uint32_t>& old_vertex) {
    GeometryError error;
    DecodedPose pose;
    std::vector<float> baked(size_t{3} * bake.identity().num_vertices);
    for (uint32_t p = 0; p < bake.num_poses(); ++p) {
        bake.read_position_rows(p, 0, baked.size(), baked.data());
        reorder_planes(baked, old_vertex);
        decode_positions(model, p, {}, pose);
        error.add(pose.positions, baked, p);
    }
    return error;
}

}  // namespace

ModelError measure_animation(const Model& model, const BakeReader& bake,
                             const BandPower& spectrum) {
    const std::vector<uint32_t> old_vertex = check_same_animation(model, bake);
    return {measure_transfer(model, bake, spectrum, old_vertex),
            measure_geometry(model, bake, old_vertex),
            {}};
}

uint64_t measure_animation_bytes(uint64_t num_vertices, uint64_t num_poses, uint64_t num_components,
                                 uint64_t num_basis_rows, uint64_t num_threads) {
    // The components of a plane as floats; the directions that the decoder can follow are the
    // constant and these components.
    return (kPlanesMeasured * num_vertices + num_basis_rows) * num_poses * sizeof(float) +
           num_vertices * num_components * sizeof(float) +
           TransferErrorMeter::scratch_bytes(num_poses, num_components + 1, num_threads);
}

ModelError measure_model(const Model& model, const BakeReader& bake, const BandPower& spectrum) {
    ModelError error = measure_animation(model, bake, spectrum);
    if (bake.scenery()) error.scenery = measure_scenery(model, bake, spectrum);
    return error;
}

std::vector<NamedError> named_errors(const ModelError& error) {
    const TransferError& transfer = error.transfer;
    const GeometryError& geometry = error.geometry;
    std::vector<NamedError> errors{
        {"transfer_error", transfer.error, true},
        {"transfer_missing_bands", transfer.missing_bands, true},
        {"transfer_total_error", transfer.total(), true},
        {"transfer_deviation", transfer.deviation, true},
        {"transfer_worst_vertex_deviation", transfer.worst_vertex_deviation, true},
        {"transfer_worst_pose_deviation", transfer.worst_pose_deviation, true},
        {"position_rms", geometry.rms(), false},
        {"position_worst", geometry.worst(), false},
        {"position_relative_rms", geometry.relative_rms(), false},
        {"position_relative_worst", geometry.relative_worst(), false},
        {"kg_error", geometry.kg_error(), false},
        {"e_rms", geometry.e_rms(), false}};
    if (!error.scenery) return errors;
    const TransferError& still = error.scenery->transfer;
    errors.insert(errors.end(),
                  {{"scenery_transfer_error", still.error, true},
                   {"scenery_transfer_missing_bands", still.missing_bands, true},
                   {"scenery_transfer_total_error", still.total(), true},
                   {"scenery_transfer_deviation", still.deviation, true},
                   {"scenery_transfer_worst_vertex_deviation", still.worst_vertex_deviation, true},
                   {"scenery_position_rms", error.scenery->geometry.rms(), false},
                   {"scenery_position_worst", error.scenery->geometry.worst(), false}});
    return errors;
}

std::string error_statement_json(const ModelError& error, const BandPower& spectrum) {
    nlohmann::ordered_json json;
    json["light_spectrum"] = spectrum.name;
    for (const NamedError& named : named_errors(error)) json[named.name] = named.value;
    // File names may have bytes that are not UTF-8.
    return json.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
}

ErrorStatement read_error_statement(const Model& model, const std::filesystem::path& file) {
    constexpr const char* kMember = "measured";
    const Metadata provenance(model.provenance_json.empty() ? "{}" : model.provenance_json,
                              file.string());
    ErrorStatement statement;
    if (provenance.root().contains(kMember)) {
        const Metadata measured(provenance.object_text(kMember), file.string());
        statement.band_power = measured.text("light_spectrum");
        ModelError with_all;
        with_all.scenery.emplace();
        for (NamedError& named : named_errors(with_all)) {
            if (!measured.root().contains(named.name)) continue;
            named.value =
                measured.number(named.name.c_str(), 0.0, std::numeric_limits<double>::max());
            statement.errors.push_back(std::move(named));
        }
    }
    if (statement.errors.empty()) {
        throw_bad_input(
            "{}: expected a file that states its errors, got none: "
            "encode with --max-error, --max-size or --measure",
            file.string());
    }
    return statement;
}

}  // namespace paim
