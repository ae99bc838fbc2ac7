// Distant light, and rotation of light.
#include "paim/light/light.h"

#include <Eigen/Geometry>

#include <utility>

#include "paim/base/check.h"
#include "paim/sh/rotate.h"

namespace paim {

LightField::~LightField() = default;

DistantLight::DistantLight(LightCoefficients coefficients)
    : coefficients_(std::move(coefficients)) {
    PAIM_CHECK_EQ(coefficients_.values.size(),
                  static_cast<size_t>(sh::num_coefficients(coefficients_.bands)));
}

LightCoefficients DistantLight::at(const Vec3f& /*place*/, int bands) const {
    LightCoefficients first{bands, coefficients_.values};
    first.values.resize(static_cast<size_t>(sh::num_coefficients(bands)), Vec3f::Zero());
    return first;
}

LightCoefficients turn(const LightCoefficients& light, const Eigen::Matrix3d& rotation) {
    PAIM_CHECK_EQ(light.values.size(), static_cast<size_t>(sh::num_coefficients(light.bands)));
    const sh::Rotation of_coefficients(light.bands, rotation);
    LightCoefficients turned{light.bands, std::vector<Vec3f>(light.values.size())};
    std::vector<float> in(light.values.size());
    std::vector<float> out(light.values.size());
    for (int c = 0; c < 3; ++c) {
        for (size_t i = 0; i < in.size(); ++i) in[i] = light.values[i][c];
        of_coefficients.apply(in, out);
        for (size_t i = 0; i < out.size(); ++i) turned.values[i][c] = out[i];
    }
    return turned;
}

LightCoefficients to_local(const LightCoefficients& light, const RigidTransform& root) {
    if (!root.turns()) return light;
    return turn(light, root.rotation.conjugate().toRotationMatrix());
}

LightCoefficients turn_about_y(const LightCoefficients& light, double angle_rad) {
    // Counter-clockwise seen from +Y is the right-hand rule: +Z goes to +X in a quarter turn.
    return turn(light, Eigen::AngleAxisd(angle_rad, Vec3d::UnitY()).toRotationMatrix());
}

}  // namespace paim
