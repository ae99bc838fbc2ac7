// What gloss loses because its frames come from decoded positions.
#include "paim/metrics/frame_error.h"

#include <algorithm>
#include <cmath>
#include <numeric>

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

// Transfer is read for so many rows at a time.
constexpr size_t kRowsInMemory = size_t{1} << 16;

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

// [R] rotation vectors of rows of a file.
// faces  of the file, whose order decides which of two faces with the same vertices counts
// rows   [R] the row of the bake for each
std::vector<Vec3f> turns_to_baked(const BakedFrames& bake, const Topology& faces,
                                  std::span<const uint32_t> rows) {
    const std::vector<Vec3f> baked = bake.positions(0);
    std::vector<Vec3f> positions;
    for (const uint32_t row : rows) positions.push_back(baked[row]);
    const auto by_faces = TangentFrames(faces, positions).at(positions), of_bake = bake.at(0);
    std::vector<Vec3f> turns;
    for (size_t r = 0; r < rows.size(); ++r) {
        const Eigen::Matrix3d turn =
            by_faces[r].transpose().cast<double>() * of_bake[rows[r]].cast<double>();
        turns.push_back(rotation_vector(Eigen::Quaterniond(turn).normalized()).cast<float>());
    }
    return turns;
}

// Rows of a file, in any order.
struct FileRows {
    const Topology& faces;
    std::span<const uint32_t> rows;      // [R] the row of the bake for each
    std::span<const uint32_t> vertices;  // [R] the point of the positions for each; empty: the same
    std::span<const Vec3f> turns;        // [R] or empty
};

// Compares the frames of a file with those of the bake.
class FrameComparison {
  public:
    FrameComparison(const BakeReader& gloss, size_t part, const LowRank& positions,
                    const FileRows& file, const BandPower& power)
        : layout_(gloss.identity().layout),
          part_(gloss, part),
          of_bake_(gloss, part),
          positions_(positions),
          file_(file),
          of_file_(file.faces, decoded_rows(0), file.turns),
          power_(power),
          sums_(part_.num_vertices()) {
        PAIM_CHECK_EQ(file.rows.size(), size_t{part_.num_vertices()});
        for (uint32_t p = 0; p < part_.num_poses(); ++p) add(p);
    }

    FrameError error() const {
        TurnedRow total;
        double worst = 0.0;
        for (const TurnedRow& of_row : sums_) {
            total.error += of_row.error;
            total.energy += of_row.energy;
            worst = std::max(worst, of_row.error);
        }
        if (total.energy == 0.0) return {};
        return {std::sqrt(std::max(0.0, total.error) / total.energy),
                std::sqrt(worst * static_cast<double>(sums_.size()) / total.energy)};
    }

  private:
    std::vector<float> decoded_rows(uint32_t p) {
        std::vector<float> decoded;
        decoder_.decode(positions_, p, positions_.num_components, decoded);
        return planes_at(decoded, file_.vertices);
    }

    void add(uint32_t p) {
        const auto of_rows = of_file_.at(decoded_rows(p)), wanted = of_bake_.at(p);
        std::vector<Eigen::Matrix3f> got(of_rows.size());  // in the order of the bake
        for (size_t r = 0; r < got.size(); ++r) got[file_.rows[r]] = of_rows[r];
        std::vector<float> planes;
        for (size_t first = 0; first < sums_.size(); first += kRowsInMemory) {
            const size_t count = std::min(kRowsInMemory, sums_.size() - first);
            planes.resize(layout_.num_planes() * count);
            for (uint32_t plane = 0; plane < layout_.num_planes(); ++plane) {
                part_.read_transfer_rows(p, plane * uint64_t{sums_.size()} + first, count,
                                         planes.data() + plane * count);
            }
            parallel_for(count, kRowsPerPiece, [&](size_t begin, size_t end) {
                for (size_t j = begin; j < end; ++j) {
                    const size_t r = first + j;
                    const Eigen::Matrix3d turn =
                        wanted[r].transpose().cast<double>() * got[r].cast<double>();
                    const TurnedRow row = error_of_turn(layout_, power_, turn, planes, count, j);
                    sums_[r].error += row.error;
                    sums_[r].energy += row.energy;
                }
            });
        }
    }

    const TransferLayout layout_;
    const BakedPart part_;
    const BakedFrames of_bake_;
    const LowRank& positions_;
    const FileRows file_;
    PositionDecoder decoder_;
    const GlossFrames of_file_;
    const BandPower& power_;
    std::vector<TurnedRow> sums_;  // [R]
};

}  // namespace

void set_frame_turns(const BakeReader& gloss, Asset& asset) {
    for (size_t part = 0; part < asset.parts.size(); ++part) {
        CodedMesh& mesh = asset.parts[part];
        const std::vector<uint32_t> rows = match_part(asset, part, gloss);
        mesh.frame_turns =
            frame_turns(turns_to_baked(BakedFrames(gloss, part), mesh.topology, rows));
    }
}

FrameError measure_frames(const BakeReader& gloss, size_t part, const LowRank& positions,
                          std::span<const uint32_t> vertices, const BandPower& power) {
    const Topology& faces = BakedPart(gloss, part).topology();
    std::vector<uint32_t> rows(faces.num_vertices);
    std::iota(rows.begin(), rows.end(), 0u);
    const std::vector<Vec3f> turns =
        turn_vectors(frame_turns(turns_to_baked(BakedFrames(gloss, part), faces, rows)));
    return FrameComparison(gloss, part, positions, {faces, rows, vertices, turns}, power).error();
}

FrameError measure_frames(const BakeReader& gloss, const Asset& asset, const BandPower& power) {
    FrameError worst;
    for (size_t part = 0; part < asset.parts.size(); ++part) {
        const CodedMesh& mesh = asset.parts[part];
        const std::vector<uint32_t> rows = match_part(asset, part, gloss);
        const std::vector<Vec3f> turns = turn_vectors(mesh.frame_turns);
        const FrameError error =
            FrameComparison(gloss, part, mesh.positions, {mesh.topology, rows, {}, turns}, power)
                .error();
        if (error.relative_rms >= worst.relative_rms) worst = error;
    }
    return worst;
}

}  // namespace paim
