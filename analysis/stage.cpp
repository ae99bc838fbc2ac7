// The scene of measurements.
#include "analysis/stage.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "paim/cli/light_options.h"
#include "paim/codec/sequence_bounds.h"
#include "paim/format/bake/baked_frames.h"
#include "paim/format/bake/baked_part.h"
#include "paim/light/light_in_place.h"
#include "paim/light/load_light.h"
#include "paim/light/sky.h"
#include "paim/mesh/face_vertices.h"
#include "paim/mesh/planes.h"
#include "paim/mesh/unit_scale.h"
#include "paim/render/render.h"
#include "paim/shade/exit_radiance.h"
#include "paim/shade/shade.h"
#include "paim/shade/turn_exit.h"

namespace paim {

std::vector<NamedLight> load_lights(const std::vector<std::filesystem::path>& environments,
                                    EnvMapping mapping, uint32_t bands) {
    std::vector<NamedLight> lights;
    const auto add = [&](const std::string& stem, const EnvironmentLight& light) {
        // Maps of the same name from different folders need different names.
        std::string name = stem;
        for (int copy = 2; std::any_of(lights.begin(), lights.end(),
                                       [&](const NamedLight& l) { return l.name == name; });
             ++copy) {
            name = fmt::format("{} ({})", stem, copy);
        }
        lights.push_back(
            {name, light, light.coefficients(static_cast<int>(bands)), light.is_black()});
    };
    if (environments.empty()) add("sky", EnvironmentLight(make_sky()));
    for (const auto& path : environments) {
        const LoadedLight loaded = load_light(path, mapping);
        cli::print_notes("paim-analyze", path, loaded.notes);
        add(path.stem().string(), loaded.light);
    }
    return lights;
}

std::string why_nothing_is_seen(const NamedLight& light) {
    return light.black ? "the light is black"
                       : "the pictures of the bake are black (the mesh covers no pixel, or no "
                         "light reaches what is seen of it)";
}

namespace {

Bounds bounds_of_poses(const BakeReader& bake, const PositionOutliers& outliers) {
    Bounds bounds;
    const std::vector<uint32_t> vertices = face_vertices(bake.topology());
    std::vector<float> planes(size_t{3} * bake.identity().num_vertices);
    for (uint32_t p = 0; p < bake.num_poses(); ++p) {
        bake.read_position_rows(p, 0, planes.size(), planes.data());
        outliers.replace(p, bake.identity().num_vertices, 0, planes);
        move_to_scene(root_at(bake.identity().root_motion, p), planes,
                      bake.identity().num_following);
        bounds.extend(bounds_of_vertices(planes, vertices));
    }
    return bounds;
}

float scale_of(const Bounds& bounds) {
    if (bounds.empty()) return 1.0f;
    const float largest =
        std::max(bounds.lower.cwiseAbs().maxCoeff(), bounds.upper.cwiseAbs().maxCoeff());
    return unit_scale(static_cast<double>(largest));
}

// The values of two meshes one after the other, for each outgoing coefficient.
std::vector<Vec3f> joined(std::span<const Vec3f> first, std::span<const Vec3f> second,
                          size_t num_outgoing) {
    std::vector<Vec3f> all;
    for (size_t o = 0; o < num_outgoing; ++o) {
        for (const std::span<const Vec3f> values : {first, second}) {
            const size_t count = values.size() / num_outgoing;
            const std::span<const Vec3f> of_coefficient = values.subspan(o * count, count);
            all.insert(all.end(), of_coefficient.begin(), of_coefficient.end());
        }
    }
    return all;
}

std::vector<float> scaled(std::vector<float> values, float scale) {
    for (float& value : values) value *= scale;
    return values;
}

}  // namespace

std::vector<Camera> Stage::make_cameras(const StageOptions& options) const {
    Bounds bounds = pose_bounds_;
    bounds.lower *= scale_;
    bounds.upper *= scale_;
    if (bake_.still_mesh()) {
        const BakedStillMesh& still = *bake_.still_mesh();
        const Bounds still_bounds =
            bounds_of_vertices(scaled(still.pose.positions, scale_), face_vertices(still.topology));
        bounds = framed_bounds(bounds, still_bounds);
    }
    std::vector<Camera> cameras;
    for (uint32_t view = 0; view < options.num_views; ++view) {
        const double azimuth = options.azimuth_rad + 2.0 * kPi * view / options.num_views;
        cameras.push_back(frame_bounds(bounds, 1.0f, static_cast<float>(azimuth),
                                       static_cast<float>(options.elevation_rad)));
    }
    return cameras;
}

Stage::Stage(const BakeReader& bake, std::vector<NamedLight> lights, const StageOptions& options)
    : bake_(bake),
      lights_(std::move(lights)),
      size_pixels_(options.size_pixels),
      outliers_(find_outliers(BakedPart(bake, 0))),
      pose_bounds_(bounds_of_poses(bake, outliers_)),
      scale_(scale_of(pose_bounds_)),
      cameras_(make_cameras(options)),
      topology_(bake.topology()),
      albedo_(bake.albedo()) {
    if (bake.still_mesh()) {
        const BakedStillMesh& still = *bake.still_mesh();
        albedo_.append(still.albedo, topology_.num_vertices, still.topology.num_vertices);
        topology_.append(still.topology);
        still_positions_ = from_planes(scaled(still.pose.positions, scale_));
        if (bake.identity().layout.kind == TransferKind::glossy) {
            still_frames_ = BakedFrames(bake, 1).at(0);
        }
    }
    const uint32_t count = std::min(options.num_poses, bake.num_poses());
    for (uint32_t j = 0; j < count; ++j) {
        poses_.push_back(static_cast<uint32_t>(uint64_t{j} * bake.num_poses() / count));
    }
}

std::string Stage::views_text() const {
    return num_views() == 1 ? "one view" : fmt::format("{} views", num_views());
}

std::vector<Vec3f> Stage::place(const DecodedPose& pose, const DecodedPose* still) const {
    std::vector<float> planes = pose.positions;
    move_to_scene(pose.root, planes, pose.num_following);
    std::vector<Vec3f> positions = from_planes(scaled(std::move(planes), scale_));
    const std::vector<Vec3f> around =
        still == nullptr ? still_positions_ : from_planes(scaled(still->positions, scale_));
    positions.insert(positions.end(), around.begin(), around.end());
    return positions;
}

std::vector<std::vector<Vec3f>> Stage::light(const DecodedPose& pose,
                                             const DecodedPose* still) const {
    std::vector<std::vector<Vec3f>> radiance(lights_.size());
    std::vector<Vec3f> scratch;
    for (size_t j = 0; j < lights_.size(); ++j) {
        const LightCoefficients& light = lights_[j].coefficients;
        light_in_place(pose.root, pose.num_following, light, radiance[j], scratch,
                       [&](const LightCoefficients& local, std::vector<Vec3f>& lit) {
                           shade(pose.layout, pose.transfer, bake_.albedo(), local, lit);
                       });
        if (!bake_.still_mesh()) continue;
        // Light in as many bands as the pose has.
        LightCoefficients kept = light;
        kept.bands = std::min(light.bands, static_cast<int>(pose.layout.in_bands));
        const BakedStillMesh& baked = *bake_.still_mesh();
        std::vector<Vec3f> around;
        if (still == nullptr) {
            shade(bake_.identity().layout, baked.pose.transfer, baked.albedo, kept, around);
        } else {
            shade(still->layout, still->transfer, baked.albedo, kept, around);
        }
        radiance[j] = joined(radiance[j], around, pose.layout.num_outgoing());
    }
    return radiance;
}

std::vector<VisiblePoints> Stage::look(const std::vector<Vec3f>& positions) const {
    std::vector<VisiblePoints> visible;
    for (const Camera& camera : cameras_) {
        visible.push_back(find_visible(topology_, positions, camera, size_pixels_, size_pixels_));
    }
    return visible;
}

std::vector<Image> Stage::draw(const std::vector<VisiblePoints>& visible,
                               const std::vector<std::vector<Vec3f>>& radiance) const {
    std::vector<Image> pictures;
    for (const VisiblePoints& points : visible) {
        for (const auto& values : radiance) {
            pictures.push_back(interpolate_image(points, topology_, values));
        }
    }
    return pictures;
}

std::vector<std::vector<Vec3f>> Stage::exit_radiance(const DecodedPose& pose,
                                                     const DecodedPose* still) const {
    std::vector<Eigen::Matrix3f> frames = pose.frames;
    if (still != nullptr) {
        frames.insert(frames.end(), still->frames.begin(), still->frames.end());
    } else {
        frames.insert(frames.end(), still_frames_.begin(), still_frames_.end());
    }
    const auto out_bands = static_cast<int>(pose.layout.out_bands);
    std::vector<std::vector<Vec3f>> exits;
    for (const std::vector<Vec3f>& in_frames : light(pose, still)) {
        exits.emplace_back(static_cast<size_t>(sh::num_coefficients(out_bands)) * frames.size());
        turn_exit(out_bands, frames, in_frames, exits.back());
    }
    return exits;
}

std::vector<Image> Stage::draw_gloss(const DecodedPose& pose, const DecodedPose* still) const {
    const std::vector<Vec3f> positions = place(pose, still);
    const std::vector<VisiblePoints> visible = look(positions);
    const std::vector<std::vector<Vec3f>> exits = exit_radiance(pose, still);
    const size_t num_moving = pose.positions.size() / 3;
    const size_t num_following = std::min<size_t>(pose.num_following, num_moving);
    std::vector<Image> pictures;
    std::vector<Vec3f> directions(positions.size()), radiance(positions.size());
    for (size_t view = 0; view < visible.size(); ++view) {
        for (size_t v = 0; v < positions.size(); ++v) {
            const Vec3f direction = (cameras_[view].eye - positions[v]).normalized();
            // Local axes of what follows the root motion.
            directions[v] =
                v < num_following
                    ? (pose.root.rotation.conjugate() * direction.cast<double>()).cast<float>()
                    : direction;
        }
        for (const std::vector<Vec3f>& exit : exits) {
            exit_towards(static_cast<int>(pose.layout.out_bands), exit, directions, radiance);
            pictures.push_back(interpolate_image(visible[view], topology_, radiance));
        }
    }
    return pictures;
}

std::vector<Image> Stage::render_pose(const DecodedPose& pose, const DecodedPose* still) const {
    if (pose.layout.kind == TransferKind::glossy) return draw_gloss(pose, still);
    return draw(look(place(pose, still)), light(pose, still));
}

DecodedPose baked_pose(const BakeReader& bake, uint32_t p, BakedPose pose) {
    const BakeIdentity& identity = bake.identity();
    std::vector<Eigen::Matrix3f> frames;
    if (identity.layout.kind == TransferKind::glossy) {
        frames = BakedFrames(bake, 0).at(p);
    }
    return {identity.layout,   std::move(pose.positions),        std::move(pose.transfer),
            std::move(frames), root_at(identity.root_motion, p), identity.num_following};
}

void keep_bands(DecodedPose& pose, uint32_t bands) {
    if (bands >= pose.layout.in_bands) return;
    const TransferLayout kept = pose.layout.with_bands(bands);
    const size_t num_vertices = pose.positions.size() / 3;
    std::vector<uint32_t> planes;
    planes_of(pose.layout, kept, planes);
    std::vector<float> transfer;
    for (const uint32_t plane : planes) {
        const auto first = pose.transfer.begin() + static_cast<ptrdiff_t>(plane * num_vertices);
        transfer.insert(transfer.end(), first, first + static_cast<ptrdiff_t>(num_vertices));
    }
    pose.layout = kept;
    pose.transfer = std::move(transfer);
}

}  // namespace paim
