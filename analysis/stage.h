// The scene of measurements: lights, cameras and poses.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "paim/codec/asset.h"
#include "paim/codec/mesh_decoder.h"
#include "paim/format/bake/bake_directory.h"
#include "paim/image/image.h"
#include "paim/light/env_mapping.h"
#include "paim/light/environment.h"
#include "paim/mesh/bounds.h"
#include "paim/mesh/outliers.h"
#include "paim/render/render.h"
#include "paim/shade/camera.h"

namespace paim {

struct NamedLight {
    std::string name;
    EnvironmentLight map;
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

// Where pictures are taken from, and of what.
struct StageOptions {
    double azimuth_rad = 0.0;  // of the first view
    double elevation_rad = 0.0;
    uint32_t num_views = 1;  // evenly about the vertical axis
    int size_pixels = 256;   // width and height
    uint32_t num_poses = 4;  // evenly over the sequence; at most all
};

// Renders baked or decoded poses of one character under several lights, against black. Where a
// function takes or returns a list of pictures, picture view · lights + light is that of the light in
// the view.
class Stage {
  public:
    // Cameras see the whole sequence (frame_bounds()). Keeps a reference to the bake.
    Stage(const BakeReader& bake, std::vector<NamedLight> lights, const StageOptions& options);

    const std::vector<NamedLight>& lights() const { return lights_; }
    const std::vector<uint32_t>& poses() const { return poses_; }
    size_t num_views() const { return cameras_.size(); }
    std::string views_text() const;  // "one view", "3 views"
    size_t num_pictures() const { return num_views() * lights_.size(); }
    // Of the bake, by its vertices.
    const PositionOutliers& outliers() const { return outliers_; }

    // Pictures of a pose, with the bake's colours. [pictures]
    // still  the still meshes, decoded; nullptr: as baked
    std::vector<Image> render_pose(const DecodedPose& pose,
                                   const DecodedPose* still = nullptr) const;

    // The steps of render_pose(), for radiance from elsewhere. Vertices are those of the bake and,
    // after them, those of its still meshes.
    const Topology& topology() const { return topology_; }
    const Albedo& albedo() const { return albedo_; }
    // Positions of a pose, as they are drawn: in the scene, scaled. [V + S]
    std::vector<Vec3f> place(const DecodedPose& pose, const DecodedPose* still = nullptr) const;
    // Radiance of a pose by its transfer, of each outgoing coefficient. [lights][num_outgoing · (V + S)]
    std::vector<std::vector<Vec3f>> light(const DecodedPose& pose,
                                          const DecodedPose* still = nullptr) const;
    // [views]
    std::vector<VisiblePoints> look(const std::vector<Vec3f>& positions) const;
    // [pictures]
    std::vector<Image> draw(const std::vector<VisiblePoints>& visible,
                            const std::vector<std::vector<Vec3f>>& radiance) const;

  private:
    // Outgoing coefficients of glossy transfer, of directions in local axes.
    // [lights][out_bands² · (V + S)]
    std::vector<std::vector<Vec3f>> exit_radiance(const DecodedPose& pose,
                                                  const DecodedPose* still) const;
    // Pictures of glossy transfer, whose radiance depends on the view. [pictures]
    std::vector<Image> draw_gloss(const DecodedPose& pose, const DecodedPose* still) const;
    std::vector<Camera> make_cameras(const StageOptions& options) const;

    const BakeReader& bake_;
    std::vector<NamedLight> lights_;
    int size_pixels_;
    PositionOutliers outliers_;
    Bounds pose_bounds_;  // of all poses, scene units
    // Scale of the rendered scene. The camera of a huge scene would otherwise be beyond the range
    // of floats.
    float scale_;
    std::vector<Camera> cameras_;  // of the scaled scene
    std::vector<uint32_t> poses_;
    Topology topology_;
    Albedo albedo_;
    std::vector<Vec3f> still_positions_;         // as baked, scaled
    std::vector<Eigen::Matrix3f> still_frames_;  // as baked, of glossy transfer
};

// A pose of a bake as if it had been decoded, with all that the bake knows of it.
DecodedPose baked_pose(const BakeReader& bake, uint32_t p, BakedPose pose);

// Keeps the first bands of a pose's transfer.
void keep_bands(DecodedPose& pose, uint32_t bands);

}  // namespace paim
