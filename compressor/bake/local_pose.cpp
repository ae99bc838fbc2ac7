// A baked pose in the local coordinates of a body that travels and turns.
#include "compressor/bake/local_pose.h"

#include <algorithm>
#include <vector>

#include "paim/base/check.h"
#include "paim/base/parallel.h"
#include "paim/mesh/planes.h"
#include "paim/sh/rotate.h"

namespace paim {

namespace {

constexpr size_t kTurnedPerPiece = 256;

// Turns the coefficients of light of one row, for every channel and outgoing coefficient.
class RowTurn {
  public:
    RowTurn(const Eigen::Matrix3d& to_local, const TransferLayout& layout)
        : layout_(layout), rotation_(static_cast<int>(layout.in_bands), to_local) {}

    // row  the first plane's value, which planes follow `stride` values apart
    void apply(float* row, size_t stride) const {
        std::vector<float> from(layout_.num_coefficients()), to(from.size());
        for (uint32_t channel = 0; channel < layout_.channels; ++channel) {
            for (uint32_t o = 0; o < layout_.num_outgoing(); ++o) {
                float* const first = row + layout_.plane(channel, 0, o) * stride;
                for (size_t i = 0; i < from.size(); ++i) from[i] = first[i * stride];
                rotation_.apply(from, to);
                for (size_t i = 0; i < to.size(); ++i) first[i * stride] = to[i];
            }
        }
    }

  private:
    const TransferLayout layout_;
    const sh::Rotation rotation_;
};

// Turns the first rows of planes.
void turn_rows(const Eigen::Matrix3d& to_local, const TransferLayout& layout, uint32_t num_turning,
               std::vector<float>& planes) {
    const RowTurn turn(to_local, layout);
    const size_t num_rows = planes.size() / layout.num_planes();
    parallel_for(std::min<size_t>(num_turning, num_rows), kTurnedPerPiece,
                 [&](size_t begin, size_t end) {
                     for (size_t r = begin; r < end; ++r) turn.apply(planes.data() + r, num_rows);
                 });
}

Eigen::Matrix3d to_local_axes(const RigidTransform& root) {
    return root.rotation.conjugate().toRotationMatrix();
}

}  // namespace

void move_to_local(const RigidTransform& root, const Vec3d& offset, const TransferLayout& layout,
                   BakedPose& pose, uint32_t num_following) {
    PAIM_CHECK(num_following >= pose.positions.size() / 3 || offset.isZero(0.0));
    const Eigen::Matrix3d to_local = to_local_axes(root);
    transform_planes(to_local, to_local * (offset - root.translation), pose.positions,
                     num_following);
    if (!root.turns()) return;
    transform_planes(to_local, Vec3d::Zero(), pose.normals, num_following);
    turn_rows(to_local, layout, num_following, pose.transfer);
    turn_rows(to_local, layout, num_following, pose.noise);
}

void turn_gloss(const RigidTransform& root, const TransferLayout& layout, BakedPose& pose,
                uint32_t num_following_rows) {
    if (!root.turns()) return;
    turn_rows(to_local_axes(root), layout, num_following_rows, pose.gloss);
    turn_rows(to_local_axes(root), layout, num_following_rows, pose.gloss_noise);
}

}  // namespace paim
