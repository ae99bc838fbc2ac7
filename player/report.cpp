// Describing pictures.
#include "player/report.h"

#include <algorithm>

#include "paim/codec/section_row.h"
#include "player/inspect/cost.h"
#include "player/render/codec_words.h"

namespace paim::player {

nlohmann::ordered_json describe_picture(const Options& options, const Scene& scene,
                                        const Presenter& presenter, const ViewState& view,
                                        const std::string& driver, int samples) {
    const CodedMesh& mesh = scene.asset->moving();
    const Cost cost = frame_cost(mesh, view.limits);
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
            limited ? std::min(*number.value, view.limits.*number.limit) : *number.value;
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
    json["texture_bytes"] = presenter.renderer().texture_bytes();
    json["buffer_bytes"] = presenter.renderer().buffer_bytes();
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

}  // namespace paim::player
