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

// Turns the coefficients of the first vertices, in every channel.
void turn(const sh::Rotation& rotation, const TransferLayout& layout, uint32_t num_following,
          std::vector<float>& planes) {
    constexpr size_t kVerticesPerPiece = 256;
    const size_t num_vertices = planes.size() / layout.num_planes();
    parallel_for(std::min<size_t>(num_following, num_vertices), kVerticesPerPiece,
                 [&](size_t begin, size_t end) {
                     std::vector<float> from(layout.num_coefficients()), to(from.size());
                     for (size_t v = begin; v < end; ++v) {
                         for (uint32_t channel = 0; channel < layout.channels; ++channel) {
                             float* const first =
                                 planes.data() + layout.plane(channel, 0) * num_vertices + v;
                             for (size_t i = 0; i < from.size(); ++i)
                                 from[i] = first[i * num_vertices];
                             rotation.apply(from, to);
                             for (size_t i = 0; i < to.size(); ++i) first[i * num_vertices] = to[i];
                         }
                     }
                 });
}

}  // namespace

void move_to_local(const RigidTransform& root, const Vec3d& offset, const TransferLayout& layout,
                   BakedPose& pose, uint32_t num_following) {
    PAIM_CHECK(num_following >= pose.positions.size() / 3 || offset.isZero(0.0));
    const Eigen::Matrix3d to_local = root.rotation.conjugate().toRotationMatrix();
    transform_planes(to_local, to_local * (offset - root.translation), pose.positions,
                     num_following);
    if (!root.turns()) return;
    transform_planes(to_local, Vec3d::Zero(), pose.normals, num_following);
    const sh::Rotation rotation(static_cast<int>(layout.in_bands), to_local);
    turn(rotation, layout, num_following, pose.transfer);
    turn(rotation, layout, num_following, pose.noise);
}

}  // namespace paim
