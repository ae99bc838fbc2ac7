// Light for shading: RGB spherical-harmonic coefficients of incident radiance at a place.
#pragma once

#include <vector>

#include "paim/base/export.h"
#include "paim/base/vector.h"
#include "paim/mesh/root_motion.h"
#include "paim/sh/index.h"

namespace paim {

// Linear RGB radiance coefficients, i = l(l+1)+m.
struct LightCoefficients {
    int bands = 0;
    std::vector<Vec3f> values;  // [bands²]
};

// Light that may differ from place to place.
class PAIM_EXPORT LightField {
  public:
    virtual ~LightField();

    // Incident radiance at a place (scene units). bands  1 … sh::kMaxBands
    virtual LightCoefficients at(const Vec3f& place, int bands) const = 0;
};

// Light from infinitely far away: the same at every place.
class PAIM_EXPORT DistantLight : public LightField {
  public:
    explicit DistantLight(LightCoefficients coefficients);

    // The first `bands` bands; bands that the light does not have are zero.
    LightCoefficients at(const Vec3f& place, int bands) const override;

  private:
    LightCoefficients coefficients_;
};

// The light turned by a rotation of the scene: what came from ω comes from rotation · ω.
PAIM_EXPORT LightCoefficients turn(const LightCoefficients& light, const Eigen::Matrix3d& rotation);

// Light of the scene in the local axes of a mesh that stands there like this.
PAIM_EXPORT LightCoefficients to_local(const LightCoefficients& light, const RigidTransform& root);

// Coefficients of the light rotated about +Y by the angle, counter-clockwise seen from above, as by
// the option --env-rotation of the tools.
PAIM_EXPORT LightCoefficients turn_about_y(const LightCoefficients& light, double angle_rad);

}  // namespace paim
