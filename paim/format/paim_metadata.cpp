// The JSON of a .paim.
#include "paim/format/paim_metadata.h"

#include <nlohmann/json.hpp>

namespace paim {

std::string paim_metadata(const Model& model) {
    nlohmann::ordered_json json;
    json["name"] = model.name;
    json["num_vertices"] = model.topology.num_vertices;
    json["num_poses"] = model.num_poses();
    json["frames_per_second"] = model.frames_per_second;
    if (const Vec3d& o = model.origin; !o.isZero(0.0)) json["origin"] = {o.x(), o.y(), o.z()};
    json["transfer_kind"] = "diffuse";
    json["bands"] = model.layout.bands;
    json["channels"] = model.layout.channels;
    if (model.vertex_order == VertexOrder::local) json["vertex_order"] = "local";
    if (!model.clusters.empty()) {
        json["clusters"] = model.clusters.num_clusters;
        json["cluster_components"] = model.clusters.num_components;
    }
    json["geometry_components"] = model.geometry.num_components;
    json["transfer_components"] = model.transfer.num_components;
    json["provenance"] =
        nlohmann::ordered_json::parse(model.provenance_json.empty() ? "{}" : model.provenance_json);
    return json.dump(2, ' ', false, nlohmann::json::error_handler_t::replace) + "\n";
}

}  // namespace paim
