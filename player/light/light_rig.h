// All the light of a scene: an environment that can be turned and dimmed, and a key light.
#pragma once

#include <cstdint>
#include <map>
#include <optional>

#include "paim/light/environment.h"
#include "player/light/key_light.h"
#include "player/light/light_orientation.h"

namespace paim::player {

// What is derived from the light is kept until the light changes. Setting what is set already changes
// nothing.
class LightRig {
  public:
    explicit LightRig(EnvironmentLight environment);

    const EnvironmentLight& environment() const { return environment_; }
    const LightOrientation& orientation() const { return orientation_; }
    const std::optional<KeyLight>& key_light() const { return key_light_; }
    float environment_strength() const { return environment_strength_; }

    void set_environment(EnvironmentLight environment);
    void set_orientation(const LightOrientation& orientation);
    void set_key_light(const std::optional<KeyLight>& key_light);
    // Factor of the environment's radiance, finite and at least 0 (checked).
    void set_environment_strength(float strength);

    // Grows whenever the light becomes another.
    uint64_t revision() const { return revision_; }

    // Incident radiance in the axes of the scene. Valid until the light changes.
    // bands  1 … sh::kMaxBands
    const LightCoefficients& coefficients(int bands);

    // Takes directions of the scene to directions of the environment's map.
    Eigen::Matrix3f environment_from_world() const;

    // How often the map was projected, which takes the longest: once for a map, and again where more
    // bands are asked for than before.
    uint64_t num_projections() const { return num_projections_; }

  private:
    void change();
    const LightCoefficients& turned_environment(int bands);

    EnvironmentLight environment_;
    LightOrientation orientation_;
    std::optional<KeyLight> key_light_;
    float environment_strength_ = 1.0f;
    uint64_t revision_ = 0;
    uint64_t num_projections_ = 0;

    // Of the environment alone, in as many bands as were asked for since it changed; no bands: not
    // computed.
    LightCoefficients projected_;
    LightCoefficients turned_;
    std::map<int, LightCoefficients> all_;  // by number of bands
};

}  // namespace paim::player
