// The scene of measurements: lights, camera and poses.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "paim/codec/asset.h"
#include "paim/codec/mesh_decoder.h"
#include "paim/format/bake/bake_directory.h"
#include "paim/image/image.h"
#include "paim/light/env_mapping.h"
#include "paim/light/light.h"
#include "paim/mesh/bounds.h"
#include "paim/mesh/outliers.h"
#include "paim/shade/camera.h"

namespace paim {

struct NamedLight {
    std::string name;
    LightCoefficients coefficients;
    bool black = false;  // nothing can be seen under it
};

// The lights of these environment maps, or the built-in sky if there are none. Says on stderr how
// maps were read, where they leave a doubt.
// Errors: those of load_light().
std::vector<NamedLight> load_lights(const std::vector<std::filesystem::path>& environments,
                                    EnvMapping mapping, uint32_t bands);

// Why a visual error under this light is not a number, as a phrase.
std::string why_nothing_is_seen(const NamedLight& light);

// Renders baked or decoded poses of one character under several lights, against black.
class Stage {
  public:
    // num_poses poses, evenly spaced, are measured. The camera sees the whole sequence from this
    // direction (frame_bounds()).
    Stage(const BakeReader& bake, std::vector<NamedLight> lights, double azimuth_rad,
          double elevation_rad, int size_pixels, uint32_t num_poses);

    const std::vector<NamedLight>& lights() const { return lights_; }
    const std::vector<uint32_t>& poses() const { return poses_; }
    // Of the bake, by its vertices.
    const PositionOutliers& outliers() const { return outliers_; }

    // Image of a pose under each light, with the bake's colours. [lights]
    std::vector<Image> render_pose(const DecodedPose& pose) const;

  private:
    Camera camera(double azimuth_rad, double elevation_rad) const;

    const BakeReader& bake_;
    std::vector<NamedLight> lights_;
    int size_pixels_;
    PositionOutliers outliers_;
    Bounds pose_bounds_;  // of all poses, scene units
    // Scale of the rendered scene. The camera of a huge scene would otherwise be beyond the range
    // of floats.
    float scale_;
    Camera camera_;  // of the scaled scene
    std::vector<uint32_t> poses_;
    Topology topology_;                   // of the poses and, after them, of the still meshes
    std::vector<Vec3f> still_positions_;  // scaled
};

}  // namespace paim
