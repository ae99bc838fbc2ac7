// The glossy transfer of a baked pose in the frames of its vertices.
#include "compressor/bake/gloss_to_frames.h"

#include "paim/base/check.h"
#include "paim/base/parallel.h"
#include "paim/mesh/face_vertices.h"
#include "paim/mesh/planes.h"
#include "paim/sh/rotate.h"

namespace paim {

namespace {

constexpr size_t kToFramesPerPiece = 64;

std::vector<uint32_t> rows_of(const Topology& topology, const Materials& materials) {
    return materials.empty() ? std::vector<uint32_t>() : glossy_rows(topology, materials);
}

// [3][V] to [R].
std::vector<Vec3f> chosen(std::span<const float> planes, const std::vector<uint32_t>& rows) {
    if (rows.empty()) return {};
    std::vector<float> of_rows(planes.begin(), planes.end());
    keep_vertices(of_rows, static_cast<uint32_t>(planes.size() / 3), rows);
    return from_planes(of_rows);
}

// [channels · O · C][R] in the axes of the pose to [channels · K · C][R].
std::vector<float> to_frames(const TransferLayout& layout, std::span<const Eigen::Matrix3f> frames,
                             const std::vector<float>& in_pose) {
    TransferLayout from = layout;
    from.kind = TransferKind::glossy_in_pose;
    const size_t num_rows = frames.size();
    PAIM_CHECK_EQ(in_pose.size(), from.num_planes() * num_rows);
    std::vector<float> in_frames(layout.num_planes() * num_rows);
    const int out_bands = static_cast<int>(layout.out_bands);
    parallel_for(num_rows, kToFramesPerPiece, [&](size_t begin, size_t end) {
        for (size_t r = begin; r < end; ++r) {
            const sh::Rotation rotation(out_bands, frames[r].transpose().cast<double>());
            for (uint32_t k = 0; k < layout.num_outgoing(); ++k) {
                const int l = sh::band_of_even(static_cast<int>(k));
                const auto turned =
                    rotation.block(l).row(sh::even_coefficient(static_cast<int>(k)) - l * l);
                for (uint32_t channel = 0; channel < layout.channels; ++channel) {
                    for (uint32_t i = 0; i < layout.num_coefficients(); ++i) {
                        double sum = 0.0;
                        for (int o = l * l; o < (l + 1) * (l + 1); ++o) {
                            const uint32_t plane = from.plane(channel, i, static_cast<uint32_t>(o));
                            sum += turned[o - l * l] *
                                   static_cast<double>(in_pose[plane * num_rows + r]);
                        }
                        in_frames[layout.plane(channel, i, k) * num_rows + r] =
                            static_cast<float>(sum);
                    }
                }
            }
        }
    });
    return in_frames;
}

}  // namespace

RowFrames::RowFrames(const Topology& topology, const Materials& materials,
                     std::span<const float> first_pose)
    : rows_(rows_of(topology, materials)),
      frames_(faces_among(topology, rows_), chosen(first_pose, rows_)) {}

std::vector<Eigen::Matrix3f> RowFrames::at(const BakedPose& pose) const {
    return frames_.at(chosen(pose.positions, rows_), chosen(pose.normals, rows_));
}

void gloss_to_frames(const TransferLayout& layout, std::span<const Eigen::Matrix3f> frames,
                     BakedPose& pose) {
    pose.gloss = to_frames(layout, frames, pose.gloss);
    pose.gloss_noise = to_frames(layout, frames, pose.gloss_noise);
    pose.statistics.gloss_rms = rms_by_band(layout, pose.gloss);
    pose.statistics.gloss_noise_rms = rms_by_band(layout, pose.gloss_noise);
}

}  // namespace paim
