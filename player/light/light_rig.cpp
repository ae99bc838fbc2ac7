// Projecting, turning and adding up what changed.
#include "player/light/light_rig.h"

#include <cmath>
#include <utility>

#include "paim/base/check.h"

namespace paim::player {

LightRig::LightRig(EnvironmentLight environment) : environment_(std::move(environment)) {}

void LightRig::change() {
    ++revision_;
    all_.clear();
}

void LightRig::set_environment(EnvironmentLight environment) {
    if (&environment.image() == &environment_.image()) return;  // copies share their image
    environment_ = std::move(environment);
    projected_ = {};
    change();
}

void LightRig::set_orientation(const LightOrientation& orientation) {
    if (orientation == orientation_) return;
    orientation_ = orientation;
    turned_ = {};
    change();
}

void LightRig::set_key_light(const std::optional<KeyLight>& key_light) {
    if (key_light == key_light_) return;
    key_light_ = key_light;
    change();
}

void LightRig::set_environment_strength(float strength) {
    PAIM_CHECK(std::isfinite(strength) && strength >= 0.0f);
    if (strength == environment_strength_) return;
    environment_strength_ = strength;
    change();
}

// At least the bands that are asked for. Bands do not depend on how many others there are.
const LightCoefficients& LightRig::turned_environment(int bands) {
    if (projected_.bands < bands) {
        projected_ = environment_.coefficients(bands);
        ++num_projections_;
        turned_ = {};
    }
    if (turned_.bands < bands) {
        // Light that is not turned keeps its bits.
        const bool turns = orientation_.wrapped() != LightOrientation();
        const LightCoefficients first = DistantLight(projected_).at(Vec3f::Zero(), bands);
        turned_ = turns ? turn(first, orientation_.rotation()) : first;
    }
    return turned_;
}

const LightCoefficients& LightRig::coefficients(int bands) {
    PAIM_CHECK(1 <= bands && bands <= sh::kMaxBands);
    if (const auto known = all_.find(bands); known != all_.end()) return known->second;
    LightCoefficients sum = DistantLight(turned_environment(bands)).at(Vec3f::Zero(), bands);
    for (Vec3f& value : sum.values) value *= environment_strength_;
    if (key_light_) {
        const LightCoefficients key = key_light_->coefficients(bands);
        for (size_t i = 0; i < sum.values.size(); ++i) sum.values[i] += key.values[i];
    }
    return all_.emplace(bands, std::move(sum)).first->second;
}

Eigen::Matrix3f LightRig::environment_from_world() const {
    return orientation_.rotation().transpose().cast<float>();
}

}  // namespace paim::player
