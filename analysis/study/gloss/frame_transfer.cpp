// Glossy transfer of one pose, straight from its definition.
#include "analysis/study/gloss/frame_transfer.h"

#include <algorithm>
#include <cmath>

#include "compressor/bake/cosine_directions.h"
#include "compressor/bake/ray_start.h"
#include "paim/base/check.h"
#include "paim/base/parallel.h"
#include "paim/base/seed.h"
#include "paim/sh/basis.h"
#include "paim/sh/rotate.h"
#include "paim/trace/ray_scene.h"

namespace paim::study {

using Eigen::Index;

namespace {

constexpr size_t kVerticesPerPiece = 64;
constexpr int kBatch = ExitFunctions::kBatch;
static_assert(kBatch == sh::BatchBasis::kBatch);

// Sums Σ_j e_k(s_j) y_i(s_j) over sixteen directions at a time.
class OuterSums {
  public:
    OuterSums(const ExitFunctions& exit, const sh::BatchBasis& basis)
        : exit_(exit),
          basis_(basis),
          num_incident_(static_cast<size_t>(sh::num_coefficients(basis.bands()))),
          exit_values_(static_cast<size_t>(exit.num_rows() * kBatch)),
          basis_values_(num_incident_ * kBatch),
          sums_(static_cast<size_t>(exit.num_rows()) * num_incident_) {}

    void clear() { std::fill(sums_.begin(), sums_.end(), 0.0); }

    // open  [kBatch] 1, or 0: the direction does not count
    void add(const Eigen::Matrix3f& frame, const float* x, const float* y, const float* z,
             const float* open) {
        float local[3][kBatch];
        for (int j = 0; j < kBatch; ++j) {
            const Vec3f to = frame.transpose() * Vec3f(x[j], y[j], z[j]);
            for (int axis = 0; axis < 3; ++axis) local[axis][j] = to[axis];
        }
        exit_.evaluate(local[0], local[1], local[2], exit_values_.data());
        basis_.evaluate(x, y, z, basis_values_.data());
        for (size_t k = 0; k < sums_.size() / num_incident_; ++k) {
            float weighted[kBatch];
            for (int j = 0; j < kBatch; ++j) {
                weighted[j] = open[j] * exit_values_[k * kBatch + static_cast<size_t>(j)];
            }
            for (size_t i = 0; i < num_incident_; ++i) {
                float sum = 0.0f;
                for (size_t j = 0; j < kBatch; ++j)
                    sum += weighted[j] * basis_values_[i * kBatch + j];
                sums_[k * num_incident_ + i] += static_cast<double>(sum);
            }
        }
    }

    const std::vector<double>& sums() const { return sums_; }

  private:
    const ExitFunctions& exit_;
    const sh::BatchBasis& basis_;
    size_t num_incident_;
    std::vector<float> exit_values_, basis_values_;
    std::vector<double> sums_;  // [K][C]
};

}  // namespace

Eigen::MatrixXf frame_transfer(const Topology& topology, const Pose& pose,
                               std::span<const Eigen::Matrix3f> frames, const ExitFunctions& exit,
                               const FrameTransferOptions& options) {
    const RayScene scene(topology, pose.positions);
    const RayStarts starts(topology, pose.positions, pose.normals);
    const CosineDirections cosine(options.rays, 1);
    const sh::BatchBasis basis(static_cast<int>(options.in_bands));
    const auto columns = static_cast<Index>(exit.num_rows() * sh::num_coefficients(basis.bands()));
    Eigen::MatrixXf transfer =
        Eigen::MatrixXf::Zero(static_cast<Index>(topology.num_vertices), columns);
    parallel_for(topology.num_vertices, kVerticesPerPiece, [&](size_t begin, size_t end) {
        DirectionArrays to;
        std::vector<float> open;
        OuterSums outer(exit, basis);
        for (size_t v = begin; v < end; ++v) {
            if (pose.normals[v].isZero(0.0f)) continue;
            cosine.generate(pose.normals[v], stream_key(options.seed, options.pose, v), 0, to);
            open.assign(to.x.size(), 1.0f);
            occluded_from(scene, starts[v], to.x.data(), to.y.data(), to.z.data(), options.rays,
                          open.data());
            for (size_t j = 0; j < open.size(); ++j) {
                open[j] = j < options.rays && open[j] == 0.0f ? 1.0f : 0.0f;
            }
            outer.clear();
            for (size_t j = 0; j < open.size(); j += kBatch) {
                outer.add(frames[v], &to.x[j], &to.y[j], &to.z[j], &open[j]);
            }
            // The density of the rays is cos θ / π, and b_o = cos θ e_o.
            for (Index c = 0; c < columns; ++c) {
                transfer(static_cast<Index>(v), c) =
                    static_cast<float>(kPi / options.rays * outer.sums()[static_cast<size_t>(c)]);
            }
        }
    });
    return transfer;
}

Eigen::MatrixXf in_pose_axes(const Eigen::MatrixXf& in_frames,
                             std::span<const Eigen::Matrix3f> frames, const ExitFunctions& exit) {
    PAIM_CHECK_EQ(in_frames.cols() % exit.num_rows(), 0);
    const Index num_incident = in_frames.cols() / exit.num_rows();
    const Index num_outgoing = sh::num_coefficients(exit.out_bands());
    Eigen::MatrixXf out(in_frames.rows(), num_outgoing * num_incident);
    parallel_for(frames.size(), kVerticesPerPiece, [&](size_t begin, size_t end) {
        Eigen::MatrixXf local(num_incident, num_outgoing);
        for (size_t v = begin; v < end; ++v) {
            const auto row = static_cast<Index>(v);
            local.setZero();
            for (int k = 0; k < exit.num_rows(); ++k) {
                local.col(exit.coefficients()[static_cast<size_t>(k)]) =
                    in_frames.row(row).segment(k * num_incident, num_incident).transpose();
            }
            const sh::Rotation rotation(exit.out_bands(), frames[v].cast<double>());
            for (int l = 0; l < exit.out_bands(); ++l) {
                const Eigen::MatrixXf turned = local.middleCols(l * l, 2 * l + 1) *
                                               rotation.block(l).transpose().cast<float>();
                out.row(row).segment(l * l * num_incident, (2 * l + 1) * num_incident) =
                    turned.reshaped().transpose();
            }
        }
    });
    return out;
}

}  // namespace paim::study
