// What gloss loses because its frames come from decoded positions.
#include "paim/metrics/frame_error.h"

#include <algorithm>
#include <cmath>

#include "paim/base/check.h"
#include "paim/base/parallel.h"
#include "paim/codec/gloss_frames.h"
#include "paim/codec/rebuild_planes.h"
#include "paim/format/bake/baked_frames.h"
#include "paim/mesh/planes.h"
#include "paim/mesh/root_motion.h"
#include "paim/metrics/asset_error.h"
#include "paim/sh/rotate.h"

namespace paim {

namespace {

constexpr size_t kRowsPerPiece = 64;

const Topology& topology_of(const BakeReader& gloss, size_t part) {
    return part == 0 ? gloss.topology() : gloss.still_mesh()->topology;
}

BakedPose read_pose(const BakeReader& gloss, size_t part, uint32_t p) {
    return part == 0 ? gloss.read_pose(p) : gloss.still_mesh()->pose;
}

// |R t − t|² of the outgoing coefficients of a row, summed over light with its weights, and Σ |t|².
struct TurnedRow {
    double error = 0.0, energy = 0.0;
};

// turn  from one frame to the other
TurnedRow error_of_turn(const TransferLayout& layout, const BandPower& power,
                        const Eigen::Matrix3d& turn, std::span<const float> planes, size_t num_rows,
                        size_t row) {
    const int out_bands = static_cast<int>(layout.out_bands);
    const sh::Rotation rotation(out_bands, turn);
    TurnedRow sums;
    std::vector<double> values(layout.num_outgoing());
    for (uint32_t channel = 0; channel < layout.channels; ++channel) {
        for (uint32_t i = 0; i < layout.num_coefficients(); ++i) {
            const double weight = power.weight(layout.input_band(layout.plane(channel, i)));
            for (uint32_t k = 0; k < values.size(); ++k) {
                values[k] =
                    static_cast<double>(planes[layout.plane(channel, i, k) * num_rows + row]);
                sums.energy += weight * values[k] * values[k];
            }
            // |R t − t|² = 2 tᵀ (1 − R) t.
            for (int l = 0; l < out_bands; ++l) {
                const Eigen::MatrixXd& block = rotation.block(l);
                const int first = sh::num_even_coefficients(l);
                for (int a = 0; a <= l; ++a) {
                    double difference = values[static_cast<size_t>(first + a)];
                    for (int b = 0; b <= l; ++b) {
                        difference -= block(2 * a, 2 * b) * values[static_cast<size_t>(first + b)];
                    }
                    sums.error +=
                        2.0 * weight * values[static_cast<size_t>(first + a)] * difference;
                }
            }
        }
    }
    return sums;
}

std::vector<float> gathered(std::span<const float> planes, std::span<const uint32_t> vertices) {
    const size_t num_vertices = planes.size() / 3;
    std::vector<float> rows;
    rows.reserve(3 * vertices.size());
    for (size_t axis = 0; axis < 3; ++axis) {
        for (const uint32_t v : vertices) rows.push_back(planes[axis * num_vertices + v]);
    }
    return rows;
}

// [R] rotation vectors, in the order of the bake.
std::vector<Vec3f> turns_to_baked(const BakeReader& gloss, size_t part) {
    const Topology& topology = topology_of(gloss, part);
    const BakedPose first = read_pose(gloss, part, 0);
    const std::vector<Vec3f> positions = from_planes(first.positions);
    const auto of_positions = TangentFrames(topology, positions).at(positions);
    const auto of_bake = BakedFrames(topology, first.positions).at(first);
    std::vector<Vec3f> turns;
    for (size_t r = 0; r < positions.size(); ++r) {
        const Eigen::Matrix3d turn =
            of_positions[r].transpose().cast<double>() * of_bake[r].cast<double>();
        turns.push_back(rotation_vector(Eigen::Quaterniond(turn).normalized()).cast<float>());
    }
    return turns;
}

// turns  [R] in the order of the bake
FrameError compare_frames(const BakeReader& gloss, size_t part, const LowRank& positions,
                          std::span<const uint32_t> vertices, std::span<const Vec3f> turns,
                          const BandPower& power) {
    const Topology& topology = topology_of(gloss, part);
    const size_t num_rows = topology.num_vertices;
    PAIM_CHECK_EQ(vertices.size(), num_rows);
    const TransferLayout& layout = gloss.identity().layout;
    PositionDecoder decoder;
    std::vector<float> decoded;
    decoder.decode(positions, 0.0, positions.num_components, decoded);
    const GlossFrames of_file(topology, gathered(decoded, vertices), turns);
    const BakedFrames of_bake(topology, read_pose(gloss, part, 0).positions);
    std::vector<TurnedRow> sums(num_rows);
    const uint32_t num_poses = part == 0 ? gloss.num_poses() : 1;
    for (uint32_t p = 0; p < num_poses; ++p) {
        const BakedPose pose = read_pose(gloss, part, p);
        decoder.decode(positions, p, positions.num_components, decoded);
        const auto got = of_file.at(gathered(decoded, vertices));
        const auto wanted = of_bake.at(pose);
        parallel_for(num_rows, kRowsPerPiece, [&](size_t begin, size_t end) {
            for (size_t r = begin; r < end; ++r) {
                const Eigen::Matrix3d turn =
                    wanted[r].transpose().cast<double>() * got[r].cast<double>();
                const TurnedRow of_row =
                    error_of_turn(layout, power, turn, pose.transfer, num_rows, r);
                sums[r].error += of_row.error;
                sums[r].energy += of_row.energy;
            }
        });
    }
    TurnedRow total;
    double worst = 0.0;
    for (const TurnedRow& of_row : sums) {
        total.error += of_row.error;
        total.energy += of_row.energy;
        worst = std::max(worst, of_row.error);
    }
    if (total.energy == 0.0) return {};
    return {std::sqrt(std::max(0.0, total.error) / total.energy),
            std::sqrt(worst * static_cast<double>(num_rows) / total.energy)};
}

}  // namespace

void set_frame_turns(const BakeReader& gloss, Asset& asset) {
    for (size_t part = 0; part < asset.parts.size(); ++part) {
        const std::vector<Vec3f> baked = turns_to_baked(gloss, part);
        std::vector<Vec3f> turns;
        for (const uint32_t row : match_part(asset, part, gloss)) turns.push_back(baked[row]);
        asset.parts[part].frame_turns = frame_turns(turns);
    }
}

FrameError measure_frames(const BakeReader& gloss, size_t part, const LowRank& positions,
                          std::span<const uint32_t> vertices, const BandPower& power) {
    const LowRank turns = frame_turns(turns_to_baked(gloss, part));
    return compare_frames(gloss, part, positions, vertices, turn_vectors(turns), power);
}

FrameError measure_frames(const BakeReader& gloss, const Asset& asset, const BandPower& power) {
    FrameError worst;
    for (size_t part = 0; part < asset.parts.size(); ++part) {
        const CodedMesh& mesh = asset.parts[part];
        const std::vector<uint32_t> rows = match_part(asset, part, gloss);
        const std::vector<Vec3f> of_file = turn_vectors(mesh.frame_turns);
        std::vector<uint32_t> vertices(rows.size());
        std::vector<Vec3f> turns(of_file.size());
        for (uint32_t v = 0; v < rows.size(); ++v) vertices[rows[v]] = v;
        for (size_t v = 0; v < of_file.size(); ++v) turns[rows[v]] = of_file[v];
        const FrameError error =
            compare_frames(gloss, part, mesh.positions, vertices, turns, power);
        if (error.relative_rms >= worst.relative_rms) worst = error;
    }
    return worst;
}

}  // namespace paim
