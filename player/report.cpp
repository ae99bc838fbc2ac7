// Describing frames.
#include "player/report.h"

#include <algorithm>

#include "paim/codec/section_row.h"
#include "paim/codec/sequence_bounds.h"
#include "player/render/codec_words.h"
#include "player/render/cost.h"
#include "player/ui/orbit_camera.h"

namespace paim::player {

nlohmann::ordered_json describe_frame(const Options& options, const Scene& scene,
                                      const SceneRenderer& renderer, const std::string& driver,
                                      int samples) {
    const CodedMesh& mesh = scene.asset->moving();
    const Cost cost = frame_cost(mesh, options.limits);
    nlohmann::ordered_json json;
    json["file"] = options.model_path.string();
    json["environment"] =
        options.environment_path ? options.environment_path->string() : "built-in sky";
    json["vertices"] = mesh.topology.num_vertices;
    json["triangles"] = mesh.topology.triangles.size();
    json["poses"] = scene.asset->num_poses();
    json["codec"] = mesh.transfer->codec_name();
    json["geometry_components"] = cost.geometry_components;
    json["transfer_components"] = cost.transfer_components;
    for (const NamedNumber& number : mesh.transfer->numbers()) {
        const bool limited = number.limit != nullptr;
        json[number.name] =
            limited ? std::min(*number.value, options.limits.*number.limit) : *number.value;
    }
    json["bands"] = cost.bands;
    json["channels"] = mesh.layout.channels;
    json["file_bytes"] = scene.size_bytes;
    if (scene.progress) {
        json["complete"] = scene.asset->complete;
        json["bytes"] = scene.progress->size_bytes;
        json["whole_bytes"] = scene.progress->whole_size_bytes;
        json["components"] = scene.progress->components;
        json["whole_components"] = scene.progress->whole_components;
    }
    json["bytes_in_use"] = cost.bytes;
    json["texture_bytes"] = renderer.texture_bytes();
    json["buffer_bytes"] = renderer.buffer_bytes();
    json["multiply_adds_per_vertex"] = cost.multiply_adds;
    for (const CodecWords& words : codec_words()) {
        const bool own = words.codec == mesh.transfer->codec_name();
        json[words.shared_work_json] = own ? cost.cpu_multiply_adds : 0;
    }
    json["size"] = {options.size.first, options.size.second};
    json["supersample"] = samples;
    json["renderer"] = driver;
    return json;
}

void set_light(Frame& frame, const Scene& scene, double env_rotation_rad) {
    frame.light = turn_about_y(scene.light, env_rotation_rad);
    // The map turns by the angle, so directions are looked up turned back by it.
    frame.environment_from_world =
        Eigen::AngleAxisf(static_cast<float>(-env_rotation_rad), Vec3f::UnitY()).toRotationMatrix();
}

Frame first_frame(const Options& options, const Scene& scene) {
    Frame frame;
    frame.time = options.pose;
    frame.limits = options.limits;
    set_light(frame, scene, options.env_rotation_rad);
    const float aspect =
        static_cast<float>(options.size.first) / static_cast<float>(options.size.second);
    frame.camera = start_camera(options.camera, scene.bounds, aspect);
    frame.bounds = pose_bounds(*scene.asset, options.pose, options.limits.geometry_components);
    frame.background = options.background;
    return frame;
}

}  // namespace paim::player
