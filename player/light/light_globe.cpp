// Looks up the light from the directions of the ball's pixels.
#include "player/light/light_globe.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "paim/base/check.h"
#include "paim/base/parallel.h"
#include "paim/image/area_average.h"
#include "player/light/reconstruct_light.h"

namespace paim::player {

namespace {

// The key light as small pictures can show it: three pixels wide at least, with the same irradiance.
std::optional<KeyLight> visible_key_light(const LightRig& rig, int size) {
    std::optional<KeyLight> key = rig.key_light();
    if (!key) return key;
    // In the middle a pixel is 2/size radians wide.
    const double narrowest_deg = 3.0 * (2.0 / size) * 180.0 / kPi;
    key->angular_diameter_deg = std::clamp(std::max(key->angular_diameter_deg, narrowest_deg),
                                           KeyLight::kMinDiameter_deg, KeyLight::kMaxDiameter_deg);
    return key;
}

// directions  [pixels] of the scene, unit
std::vector<Vec3f> radiance_from(const LightRig& rig, const EnvironmentLight& map, int size,
                                 const std::vector<Vec3f>& directions) {
    const std::optional<KeyLight> key = visible_key_light(rig, size);
    const Vec3f of_disc = key ? Vec3f(key->disc_radiance().cast<float>()) : Vec3f(Vec3f::Zero());
    const Eigen::Matrix3d environment_from_world = rig.orientation().rotation().transpose();
    std::vector<Vec3f> radiance(directions.size());
    parallel_for(directions.size(), 512, [&](size_t begin, size_t end) {
        for (size_t i = begin; i < end; ++i) {
            const Vec3d direction = directions[i].cast<double>();
            radiance[i] =
                rig.environment_strength() * map.radiance(environment_from_world * direction);
            if (key && key->covers(direction)) radiance[i] += of_disc;
        }
    });
    return radiance;
}

}  // namespace

void LightGlobe::set_size(int size) {
    PAIM_CHECK(1 <= size && size <= kMaxSize);
    if (size == size_) return;
    size_ = size;
    pixels_.clear();
    directions_.clear();
    for (int y = 0; y < size; ++y) {
        for (int x = 0; x < size; ++x) {
            const double right = (2.0 * x + 1.0) / size - 1.0;
            const double up = 1.0 - (2.0 * y + 1.0) / size;
            const double rest = 1.0 - right * right - up * up;
            if (rest < 0.0) continue;
            pixels_.push_back(static_cast<size_t>(y) * static_cast<size_t>(size) +
                              static_cast<size_t>(x));
            directions_.push_back(Vec3d(right, up, std::sqrt(rest)).cast<float>());
        }
    }
}

void LightGlobe::set_map(const EnvironmentLight& environment) {
    // Holding the light keeps its image from being replaced by another at the same address.
    if (&environment.image() == &map_.image() && map_size_ == size_) return;
    map_ = environment;
    map_size_ = size_;
    // As many pixels as the ball has across its middle, where a pixel is 2/size radians wide.
    small_map_ = EnvironmentLight::of_checked(fit_latlong(map_.image(), 4 * size_, 2 * size_));
}

LightGlobe::Pictures LightGlobe::draw(LightRig& rig, const Eigen::Matrix3f& camera_axes, int bands,
                                      int size, const Vec3f& background) {
    set_size(size);
    set_map(rig.environment());
    std::vector<Vec3f> directions(directions_.size());
    for (size_t i = 0; i < directions.size(); ++i) directions[i] = camera_axes * directions_[i];

    const std::vector<Vec3f> light = radiance_from(rig, small_map_, size, directions);
    const LightCoefficients& coefficients = rig.coefficients(bands);
    std::vector<Vec3f> reconstruction(directions.size());
    reconstruct_light(coefficients, directions, reconstruction);

    Pictures pictures{Image(size, size, background), Image(size, size, background),
                      negative_share(coefficients)};
    for (size_t i = 0; i < pixels_.size(); ++i) {
        pictures.light.pixels[pixels_[i]] = light[i];
        pictures.reconstruction.pixels[pixels_[i]] = reconstruction[i].cwiseMax(0.0f);
    }
    return pictures;
}

}  // namespace paim::player
