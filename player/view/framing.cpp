// Fitting the view to points.
#include "player/view/framing.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "paim/codec/rebuild_planes.h"
#include "paim/codec/sequence_bounds.h"
#include "player/view/body_path.h"

namespace paim::player {

namespace {

// How far the camera stays from the nearest point, as a share of the depth of all points.
constexpr double kNearest = 1e-3;

constexpr uint64_t kMaxMultiplyAdds = uint64_t{1} << 29;  // about a tenth of a second on one core

// Adds the body at moments of the animation.
class BodyFit {
  public:
    BodyFit(const CodedMesh& mesh, BodyPath* path)
        : mesh_(mesh), path_(path), vertices_(body_vertices(mesh)) {}

    bool empty() const { return vertices_.empty(); }

    void add(double time, FrustumFit& fit) {
        const LowRank& positions = mesh_.positions;
        decoder_.decode(positions, time, positions.num_usual_components(), planes_);
        const RigidTransform root = root_at(mesh_.root_motion, time);
        const Vec3d origin = path_ != nullptr ? path_->at(time) : Vec3d::Zero();
        const size_t num_points = positions.num_points;
        for (const uint32_t v : vertices_) {
            const Vec3f local(planes_[v], planes_[num_points + v], planes_[2 * num_points + v]);
            fit.add(root.to_scene(local.cast<double>()) - origin);
        }
    }

  private:
    const CodedMesh& mesh_;
    BodyPath* path_;
    std::vector<uint32_t> vertices_;
    PositionDecoder decoder_;
    std::vector<float> planes_;
};

// Every n-th pose, so that decoding them takes a bounded time.
uint64_t pose_step(const CodedMesh& mesh) {
    const LowRank& positions = mesh.positions;
    const uint64_t work =
        uint64_t{3} * positions.num_points * (uint64_t{positions.num_components} + 4);
    const uint64_t most = std::max<uint64_t>(2, kMaxMultiplyAdds / std::max<uint64_t>(1, work));
    return (mesh.num_poses() + most - 1) / most;
}

}  // namespace

std::optional<Vec3f> project(const Camera& camera, float aspect, const Vec3f& point) {
    const Vec3f local = camera.axes().transpose() * (point - camera.eye);
    if (!(local.z() < 0.0f)) return std::nullopt;
    const float half_height = std::tan(0.5f * camera.vertical_fov_rad) * -local.z();
    return Vec3f(0.5f + 0.5f * local.x() / (half_height * aspect),
                 0.5f - 0.5f * local.y() / half_height, -local.z());
}

const Vec3d FrustumFit::kNone = Vec3d::Constant(-std::numeric_limits<double>::infinity());

FrustumFit::FrustumFit(float azimuth_rad, float elevation_rad, float aspect, float fill)
    : from_origin_(frame_bounds({}, aspect, azimuth_rad, elevation_rad)),
      to_camera_(from_origin_.axes().transpose().cast<double>()) {
    const double slope = double{fill} * std::tan(0.5 * double{from_origin_.vertical_fov_rad});
    slope_ = {slope * double{aspect}, slope, 1.0};
}

void FrustumFit::add(const Vec3d& point) {
    const Vec3d p = to_camera_ * point;
    const Vec3d depth(slope_.x() * p.z(), slope_.y() * p.z(), 0.0);
    highest_ = highest_.cwiseMax(p + depth);
    lowest_ = lowest_.cwiseMax(depth - p);
}

Camera FrustumFit::camera() const {
    if (highest_ == kNone) return from_origin_;
    const Vec3d middle = 0.5 * (highest_ - lowest_);  // of x and y: where the camera is; of z
    const Vec3d depth = 0.5 * (highest_ + lowest_).cwiseQuotient(slope_);
    const double extent = highest_.z() + lowest_.z();
    double z = std::max({depth.x(), depth.y(), highest_.z() + kNearest * extent});
    // Of a single point nothing but rounding is left.
    constexpr double kRounding = 1e-6;
    if (!(z - middle.z() > kRounding * middle.cwiseAbs().maxCoeff())) z = middle.z() + 1.0;
    Camera camera = from_origin_;
    const Eigen::Matrix3d to_scene = to_camera_.transpose();
    camera.target = (to_scene * middle).cast<float>();
    camera.eye = (to_scene * Vec3d(middle.x(), middle.y(), z)).cast<float>();
    return camera;
}

Camera frame_asset(const Asset& asset, float azimuth_rad, float elevation_rad, float aspect,
                   BodyPath* path) {
    const CodedMesh& mesh = asset.moving();
    BodyFit body(mesh, path);
    if (body.empty()) {
        return frame_bounds(sequence_bounds(asset), aspect, azimuth_rad, elevation_rad);
    }
    FrustumFit fit(azimuth_rad, elevation_rad, aspect);
    const uint64_t step = pose_step(mesh), last = asset.num_poses() - 1;
    for (uint64_t p = 0; p < last; p += step) body.add(static_cast<double>(p), fit);
    body.add(static_cast<double>(last), fit);
    return fit.camera();
}

Camera frame_pose(const Asset& asset, double time, float azimuth_rad, float elevation_rad,
                  float aspect, BodyPath* path) {
    BodyFit body(asset.moving(), path);
    if (body.empty()) {
        return frame_bounds(sequence_bounds(asset), aspect, azimuth_rad, elevation_rad);
    }
    FrustumFit fit(azimuth_rad, elevation_rad, aspect);
    body.add(time, fit);
    return fit.camera();
}

}  // namespace paim::player
