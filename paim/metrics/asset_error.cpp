// Errors of a compressed animation to the bake that it was made from.
#include "paim/metrics/asset_error.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>

#include "paim/base/error.h"
#include "paim/base/json_text.h"
#include "paim/base/parallel.h"
#include "paim/codec/component_planes.h"
#include "paim/codec/rebuild_planes.h"
#include "paim/format/container/metadata.h"
#include "paim/mesh/cache_order.h"
#include "paim/mesh/face_vertices.h"
#include "paim/metrics/pose_space.h"
#include "paim/metrics/vertex_match.h"

namespace paim {

using Eigen::Index;
using Eigen::MatrixXf;

namespace {

void expect_equal(const BakeReader& bake, const char* what, uint64_t expected, uint64_t got) {
    if (expected == got) return;
    throw_bad_input("{}: expected a file made from this bake, with {} {}, got {}",
                    bake.directory().string(), expected, what, got);
}

// Keeps the rows of these vertices, ascending, in place.
void keep_rows(MatrixXf& matrix, const std::vector<uint32_t>& vertices) {
    if (static_cast<Index>(vertices.size()) == matrix.rows()) return;
    matrix = matrix(vertices, Eigen::all).eval();
}

// Reads planes of a bake for the vertices of a file.
class PlaneSource {
  public:
    // counted  vertices of the file that a face has, ascending
    PlaneSource(const BakedPart& bake, const std::vector<uint32_t>& old_vertex,
                const std::vector<uint32_t>& counted)
        : bake_(bake), old_vertex_(old_vertex), counted_(counted) {}

    // values  [counted][P]
    void read_baked(uint32_t plane, MatrixXf& values) const {
        read(&BakedPart::read_transfer_rows, plane, values);
    }
    void read_noise(uint32_t plane, MatrixXf& values) const {
        read(&BakedPart::read_noise_rows, plane, values);
    }

  private:
    void read(void (BakedPart::*read_rows)(uint32_t, uint64_t, uint64_t, float*) const,
              uint32_t plane, MatrixXf& values) const {
        const uint32_t num_vertices = bake_.num_vertices();
        values.resize(static_cast<Index>(num_vertices), static_cast<Index>(bake_.num_poses()));
        parallel_for(bake_.num_poses(), 1, [&](size_t p, size_t) {
            float* const column = values.col(static_cast<Index>(p)).data();
            (bake_.*read_rows)(static_cast<uint32_t>(p), uint64_t{plane} * num_vertices,
                               num_vertices, column);
            reorder_planes({column, num_vertices}, old_vertex_);
        });
        keep_rows(values, counted_);
    }

    const BakedPart& bake_;
    const std::vector<uint32_t>& old_vertex_;
    const std::vector<uint32_t>& counted_;
};

// The points of a mesh whose points are not the vertices, with its counted vertices.
std::optional<DecodedPoints> decoded_points(const CodedMesh& mesh, const TransferLayout& of_bake,
                                            const std::vector<uint32_t>& counted) {
    std::optional<PointGroups> groups = mesh.transfer->point_groups();
    if (!groups) return {};
    keep_rows(groups->factors, counted);
    for (size_t j = 0; j < counted.size(); ++j) groups->group[j] = groups->group[counted[j]];
    groups->group.resize(counted.size());
    return DecodedPoints{std::move(*groups),
                         [&mesh, of_bake](uint32_t plane) -> std::optional<MatrixXf> {
                             const auto stored = plane_of_file(mesh.layout, of_bake, plane);
                             if (!stored) return {};
                             return rebuild_sequence(mesh.transfer->matrix, *stored);
                         }};
}

TransferError measure_transfer(const CodedMesh& mesh, const PlaneSource& source,
                               const TransferLayout& layout, const BandPower& spectrum,
                               const std::vector<uint32_t>& counted) {
    const uint32_t num_poses = mesh.num_poses();
    TransferErrorMeter meter(layout, static_cast<uint32_t>(counted.size()), num_poses, spectrum,
                             orthonormal_pose_space(mesh.transfer->matrix.weights, num_poses),
                             decoded_points(mesh, layout, counted));
    MatrixXf baked, noise;
    for (uint32_t plane = 0; plane < layout.num_planes(); ++plane) {
        if (!plane_of_file(mesh.layout, layout, plane)) continue;
        source.read_baked(plane, baked);
        source.read_noise(plane, noise);
        meter.survey(plane, baked, noise);
    }
    for (uint32_t plane = 0; plane < layout.num_planes(); ++plane) {
        source.read_baked(plane, baked);
        source.read_noise(plane, noise);
        MatrixXf decoded;
        if (const auto stored = plane_of_file(mesh.layout, layout, plane)) {
            decoded = decode_plane(mesh, Attribute::transfer, *stored);
            keep_rows(decoded, counted);
        } else {
            decoded.setZero(baked.rows(), baked.cols());
        }
        meter.add(plane, baked, noise, decoded);
    }
    TransferError error = meter.result();
    error.worst_vertex = counted[error.worst_vertex];
    return error;
}

// Adds the errors of outliers, and puts both into the places where they usually are.
// outliers  of pose p, by vertices of the file
void take_out(const PositionOutliers& outliers, uint32_t p, std::span<float> decoded,
              std::span<float> baked, DistanceError& error) {
    const size_t num_vertices = baked.size() / 3;
    for (const PositionOutlier& outlier : outliers.of_pose(p)) {
        Vec3f position;
        for (size_t axis = 0; axis < 3; ++axis) {
            position[static_cast<int>(axis)] = decoded[axis * num_vertices + outlier.vertex];
        }
        error.add({position.data(), 3}, {outlier.position.data(), 3}, p);
    }
    for (const std::span<float> planes : {decoded, baked}) {
        outliers.replace(p, static_cast<uint32_t>(num_vertices), 0, planes);
    }
}

}  // namespace

std::vector<uint32_t> match_part(const Asset& asset, size_t number, const BakeReader& bake) {
    expect_equal(bake, "parts", num_baked_parts(bake), asset.parts.size());
    const BakedPart baked(bake, number);
    const CodedMesh& mesh = asset.parts[number];
    const bool still = number > 0;
    expect_equal(bake, still ? "vertices of still meshes" : "vertices", baked.num_vertices(),
                 mesh.topology.num_vertices);
    expect_equal(bake, "poses", baked.num_poses(), mesh.num_poses());
    std::vector<uint32_t> old_vertex = match_vertices(
        mesh.topology, asset.vertex_order, baked.topology(), bake.directory().string(),
        still ? "triangles of the still meshes" : "triangles",
        bake.identity().layout.kind == TransferKind::glossy ? TriangleOrder::any
                                                            : TriangleOrder::same);
    // Positions and transfer are compared in local coordinates.
    if (mesh.root_motion != baked.root_motion() ||
        mesh.num_following != new_number_of_first(baked.num_following(), old_vertex)) {
        throw_bad_input("{}: expected a file made from this bake, got one of another root motion",
                        bake.directory().string());
    }
    const TransferLayout& layout = bake.identity().layout;
    if (mesh.layout.kind != layout.kind || mesh.layout.in_bands > layout.in_bands ||
        (mesh.layout.channels != 1 && mesh.layout.channels != layout.channels)) {
        throw_bad_input(
            "{}: expected a file made from this bake, of {} bands and {} channels at most, got {} "
            "and {}",
            bake.directory().string(), layout.in_bands, layout.channels, mesh.layout.in_bands,
            mesh.layout.channels);
    }
    // A file may have fewer than its bake: the highest are left out where they are zero.
    if (mesh.layout.out_bands > layout.out_bands) {
        expect_equal(bake, "bands of outgoing radiance", layout.out_bands, mesh.layout.out_bands);
    }
    return old_vertex;
}

PartMeter::PartMeter(const Asset& asset, size_t number, const BakeReader& bake,
                     const std::optional<PositionOutliers>& outliers)
    : bake_(bake),
      baked_(bake, number),
      old_vertex_(match_part(asset, number, bake)),
      outliers_((outliers ? *outliers : find_outliers(baked_)).reordered(old_vertex_)),
      num_following_(asset.parts[number].num_following),
      shape_(asset.parts[number].topology, sample_poses()) {}

// Baked positions of some poses, spread evenly over all, without outliers.
std::vector<std::vector<float>> PartMeter::sample_poses() const {
    const uint32_t num_poses = baked_.num_poses();
    std::vector<std::vector<float>> samples(std::min(num_poses, kPosesMeasured));
    parallel_for(samples.size(), 1, [&](size_t j, size_t) {
        const auto p = static_cast<uint32_t>(uint64_t{j} * num_poses / samples.size());
        read_baked(p, samples[j]);
        outliers_.replace(p, baked_.num_vertices(), 0, samples[j]);
    });
    return samples;
}

void PartMeter::read_baked(uint32_t p, std::vector<float>& planes) const {
    planes.resize(size_t{3} * baked_.num_vertices());
    baked_.read_position_rows(p, 0, planes.size(), planes.data());
    reorder_planes(planes, old_vertex_);
}

SurfaceError PartMeter::surface(const LowRank& positions) const {
    SurfaceError error;
    ShapeErrorMeter shape(shape_);
    const size_t num_sized = num_below(num_following_, shape_.face_vertices);
    const uint32_t num_poses = baked_.num_poses();
    std::vector<ShapeErrorMeter::Pose> poses(std::min(num_poses, kPosesMeasured));
    for (uint32_t first = 0; first < num_poses; first += kPosesMeasured) {
        poses.resize(std::min(num_poses - first, kPosesMeasured));
        parallel_for(poses.size(), 1, [&](size_t j, size_t) {
            const auto p = static_cast<uint32_t>(first + j);
            read_baked(p, poses[j].reference);
            PositionDecoder().decode(positions, p, positions.num_components, poses[j].positions);
        });
        for (size_t j = 0; j < poses.size(); ++j) {
            take_out(outliers_, static_cast<uint32_t>(first + j), poses[j].positions,
                     poses[j].reference, error.outliers);
        }
        shape.add(poses);
        for (size_t j = 0; j < poses.size(); ++j) {
            for (auto* const planes : {&poses[j].reference, &poses[j].positions}) {
                keep_vertices(*planes, baked_.num_vertices(), shape_.face_vertices);
            }
            error.geometry.add(poses[j].positions, poses[j].reference,
                               static_cast<uint32_t>(first + j), num_sized);
        }
    }
    DistanceError& distance = error.geometry.distance;
    distance.worst_vertex = shape_.face_vertices[distance.worst_vertex];
    error.shape = shape.result();
    return error;
}

TransferError PartMeter::transfer(const CodedMesh& mesh, const BandPower& spectrum) const {
    return measure_transfer(mesh, {baked_, old_vertex_, shape_.face_vertices},
                            bake_.identity().layout, spectrum, shape_.face_vertices);
}

MeshError PartMeter::measure(const CodedMesh& mesh, const BandPower& spectrum) const {
    return {surface(mesh.positions), transfer(mesh, spectrum)};
}

uint64_t PartMeter::kept_bytes(uint64_t num_vertices, uint64_t num_triangles) {
    return num_vertices * sizeof(uint32_t) + ShapeNeighbours::bytes(num_vertices, num_triangles);
}

uint64_t measure_part_bytes(uint64_t num_vertices, uint64_t num_poses, uint64_t num_components,
                            uint64_t num_points, uint64_t num_points_each) {
    // The components of a plane as floats; the directions that the decoder can follow are the
    // constant and these components.
    const uint64_t of_transfer =
        (kPlanesMeasured * num_vertices + num_points) * num_poses * sizeof(float) +
        num_vertices * num_components * sizeof(float) +
        TransferErrorMeter::bytes(num_vertices, num_poses, std::min(num_components + 1, num_poses),
                                  num_points, num_points_each);
    const uint64_t at_once = std::min<uint64_t>(num_poses, kPosesMeasured);
    const uint64_t of_surface = at_once * 2 * 3 * num_vertices * sizeof(float) +
                                ShapeErrorMeter::bytes(num_vertices, at_once);
    return std::max(of_transfer, of_surface);
}

AssetError measure_asset(const Asset& asset, const BakeReader& bake, const BandPower& spectrum) {
    const auto still_vertices = [](const Topology* topology) -> uint64_t {
        return topology == nullptr ? 0 : topology->num_vertices;
    };
    expect_equal(bake, "vertices of still meshes",
                 still_vertices(bake.still_mesh() ? &bake.still_mesh()->topology : nullptr),
                 still_vertices(asset.still() ? &asset.still()->topology : nullptr));
    const auto measure = [&](size_t number) {
        return PartMeter(asset, number, bake).measure(asset.parts[number], spectrum);
    };
    AssetError error{measure(0), {}};
    if (asset.still() != nullptr) error.still = measure(1);
    return error;
}

std::vector<NamedError> named_errors(const AssetError& error) {
    const TransferError& transfer = error.transfer;
    const GeometryError& geometry = error.geometry;
    std::vector<NamedError> errors{
        {"transfer_error", transfer.error, true},
        {"transfer_missing_bands", transfer.missing_bands, true},
        {"transfer_total_error", transfer.total(), true},
        {"transfer_deviation", transfer.error_to_bake, true},
        {"transfer_worst_vertex_deviation", transfer.worst_vertex_error_to_bake, true},
        {"transfer_worst_pose_deviation", transfer.worst_pose_error_to_bake, true},
        {"position_rms", geometry.rms(), false},
        {"position_worst", geometry.worst(), false},
        {"position_relative_rms", geometry.relative_rms(), false},
        {"position_relative_worst", geometry.relative_worst(), false},
        {"kg_error", geometry.kg_error(), false},
        {"e_rms", geometry.e_rms(), false},
        {"sted", error.shape.whole.sted(), false},
        {"sted_worst_piece", error.shape.worst.sted(), false},
        {"normal_angle_deg", error.shape.whole.normal_angle_deg, false},
        {"normal_angle_deg_worst_piece", error.shape.worst.normal_angle_deg, false}};
    if (error.outliers.num_vertices > 0) {
        errors.push_back({"position_outlier_worst", error.outliers.worst, false});
    }
    if (!error.still) return errors;
    const TransferError& still = error.still->transfer;
    errors.insert(
        errors.end(),
        {{"scenery_transfer_error", still.error, true},
         {"scenery_transfer_missing_bands", still.missing_bands, true},
         {"scenery_transfer_total_error", still.total(), true},
         {"scenery_transfer_deviation", still.error_to_bake, true},
         {"scenery_transfer_worst_vertex_deviation", still.worst_vertex_error_to_bake, true},
         {"scenery_sted_worst_piece", error.still->shape.worst.sted(), false},
         {"scenery_normal_angle_deg_worst_piece", error.still->shape.worst.normal_angle_deg, false},
         {"scenery_position_rms", error.still->geometry.rms(), false},
         {"scenery_position_worst", error.still->geometry.worst(), false}});
    return errors;
}

std::optional<double> ErrorStatement::value(std::string_view name) const {
    const auto found = std::find_if(errors.begin(), errors.end(),
                                    [&](const NamedError& error) { return error.name == name; });
    if (found == errors.end()) return {};
    return found->value;
}

std::string error_statement_json(const AssetError& error, const BandPower& spectrum) {
    nlohmann::ordered_json json;
    json["light_spectrum"] = spectrum.name;
    for (const NamedError& named : named_errors(error)) {
        // Where nothing is as large as the error, as in a mesh that is a point, nothing is stated.
        if (std::isfinite(named.value)) json[named.name] = named.value;
    }
    // Names of files may have bytes that are not UTF-8, which are replaced.
    return json_text(json);
}

ErrorStatement read_error_statement(const Asset& asset, const std::filesystem::path& file) {
    constexpr const char* kMember = "measured";
    const Metadata provenance(asset.provenance_json.empty() ? "{}" : asset.provenance_json,
                              file.string());
    ErrorStatement statement;
    if (provenance.root().contains(kMember)) {
        const Metadata measured(provenance.object_text(kMember), file.string());
        statement.band_power = measured.text("light_spectrum");
        AssetError with_all;
        with_all.still.emplace();
        with_all.outliers.num_vertices = 1;
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
