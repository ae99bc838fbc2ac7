// The scene that is measured: lights, camera and poses.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "paim/codec/mesh_decoder.h"
#include "paim/codec/asset.h"
#include "paim/format/bake/bake_directory.h"
#include "paim/image/image.h"
#include "paim/light/light.h"
#include "paim/shade/camera.h"

namespace paim {

struct NamedLight {
    std::string name;
    LightCoefficients coefficients;
};

// The lights of these environment maps, or the built-in sky if there are none.
// Errors: those of read_exr and EnvironmentLight, naming the file.
std::vector<NamedLight> load_lights(const std::vector<std::filesystem::path>& environments,
                                    uint32_t bands);

// Renders baked or decoded poses of one character under several lights, against black.
class Stage {
  public:
    // num_poses poses, evenly spaced, are measured.
    Stage(const BakeReader& bake, std::vector<NamedLight> lights, const Camera& camera,
          int size_pixels, uint32_t num_poses);

    const std::vector<NamedLight>& lights() const { return lights_; }
    const std::vector<uint32_t>& poses() const { return poses_; }

    // Image of a pose under each light, with the bake's colours. [lights]
    std::vector<Image> render_pose(const DecodedPose& pose) const;

  private:
    const BakeReader& bake_;
    std::vector<NamedLight> lights_;
    Camera camera_;
    int size_pixels_;
    std::vector<uint32_t> poses_;
    Topology topology_;  // of the poses and, after them, of what stands still
    std::vector<Vec3f> still_positions_;
};

// Camera that sees the whole sequence.
Camera stage_camera(const BakeReader& bake, double azimuth_rad, double elevation_rad);

}  // namespace paim
