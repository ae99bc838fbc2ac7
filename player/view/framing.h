// Where a camera stands so that points fill a given part of the picture.
#pragma once

#include <optional>

#include "paim/codec/asset.h"
#include "paim/shade/camera.h"
#include "player/view/body_path.h"

namespace paim::player {

// The part of the shorter side of the picture that the points fill.
constexpr float kFill = 0.8f;

// Where a point of the scene is in the picture: x and y from 0 to 1 from the upper left corner, z its
// distance along the view. Nothing for a point behind the camera.
std::optional<Vec3f> project(const Camera& camera, float aspect, const Vec3f& point);

// Finds the nearest camera, in a fixed direction, whose picture has all points within the middle part
// `fill` of its width and its height. Points are added one after the other.
//
// In the camera's axes (x right, y up, z towards the camera) a camera at height c and depth d sees a
// point (y, z) within the middle part if |y − c| ≤ t (d − z), t = fill · tan(fov / 2). Of all points
// only the largest y + t z and the largest t z − y count; where both bounds are met, they give c and d.
// The same holds for x.
class FrustumFit {
  public:
    // azimuth_rad, elevation_rad  as frame_bounds()'s
    // aspect                      width / height of the picture
    FrustumFit(float azimuth_rad, float elevation_rad, float aspect, float fill = kFill);

    void add(const Vec3d& point);

    // A camera that looks at the middle of the points. One that looks from afar at the origin if no
    // point was added, and at the point if there is only one.
    Camera camera() const;

  private:
    Camera from_origin_;  // in the same direction, at distance 1 from the origin
    Eigen::Matrix3d to_camera_;
    Vec3d slope_;  // t of x and y
    Vec3d lowest_ = kNone,
          highest_ = kNone;  // the largest t z − x and x + t z; the same of y; −z and z

    static const Vec3d kNone;
};

// A camera that sees the body of the asset in all poses like this: the part that moves, without its
// floor. Of long animations every n-th pose is looked at, so that it takes a fraction of a second.
// Assets without such a body are framed by their bounds.
// path  if not null: relative to where this path is in each pose, for a camera that goes along
Camera frame_asset(const Asset& asset, float azimuth_rad, float elevation_rad, float aspect,
                   BodyPath* path = nullptr);

// The same of one moment.
Camera frame_pose(const Asset& asset, double time, float azimuth_rad, float elevation_rad,
                  float aspect, BodyPath* path = nullptr);

}  // namespace paim::player
