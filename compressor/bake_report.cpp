// The report of paim-compress about a bake, as text and as JSON.
#include "compressor/bake_report.h"

#include <fmt/format.h>

#include <cmath>

#include "compressor/mesh_warnings.h"
#include "paim/cli/root_motion_json.h"

namespace paim {

using nlohmann::ordered_json;

namespace {

double share(uint64_t part, uint64_t whole) {
    return whole > 0 ? static_cast<double>(part) / static_cast<double>(whole) : 0.0;
}

std::string noise_target_text(const BakeReport& report) {
    const double target = report.options.transfer_error;
    if (!(target > 0.0)) return {};
    const uint32_t above = report.summary.total.above_target;
    if (above == 0) {
        return fmt::format(
            "  noise at every vertex is within {:g} % of an unshadowed vertex's transfer, before "
            "any bounces\n",
            100.0 * target);
    }
    return fmt::format(
        "  {} vertices (over all poses) had {} rays and are still above the noise target of {:g} "
        "%: raise --rays\n",
        above, report.options.rays, 100.0 * target);
}

std::string bounces_text(const BakeReport& report) {
    if (report.options.bounces == 0) return {};
    return fmt::format("  {} bounces in {}; {:.2g} % of the rays ended on the back of a face\n",
                       report.options.bounces, report.channels == 3 ? "colour" : "grey",
                       100.0 * report.back_hit_share());
}

std::string surroundings_text(const BakeReport& report) {
    std::string text;
    if (!report.floor.empty()) {
        const std::string origin =
            report.origin_y != 0.0
                ? fmt::format(" (y counted from the origin's, {})", report.origin_y)
                : "";
        text += fmt::format("  on a floor of {}{}\n", report.floor, origin);
    }
    if (report.still_vertices > 0) {
        text += fmt::format("  among still meshes of {} vertices and {} triangles\n",
                            report.still_vertices, report.still_triangles);
    }
    return text;
}

std::string root_motion_text(const RootMotion& motion) {
    if (motion.empty()) return {};
    const Travel travel = travel_of(motion);
    return fmt::format(
        "  root motion ({}): the body travels {:.4g} and turns by {:.4g} degrees from pose to pose, "
        "added up\n",
        travel.angle_deg > 0.0 ? "rigid" : "translation", travel.distance, travel.angle_deg);
}

// What the vertex colours of a mesh are taken as; `of` says of which.
std::string colours_text(const VertexColours& colours, const std::string& of) {
    if (!colours.used) return {};
    std::string text =
        fmt::format("  vertex colours{} are taken as {}", of, colours.srgb ? "sRGB" : "linear");
    if (!colours.chosen && colours.srgb)
        text += fmt::format(", as {} writes them", colours.exporter);
    if (!colours.chosen && !colours.srgb) text += "; if they are not: --vertex-colours srgb";
    return text + '\n';
}

void add_colours(ordered_json& json, const VertexColours& colours) {
    if (colours.used) json["vertex_colours"] = colours.srgb ? "srgb" : "linear";
}

}  // namespace

double BakeReport::rays_per_vertex() const {
    const double traced = static_cast<double>(num_vertices) * (last_pose - first_pose + 1.0) -
                          static_cast<double>(summary.total.zero_normals);
    return traced > 0.0 ? static_cast<double>(summary.total.rays) / traced : 0.0;
}

double BakeReport::occluded_share() const {
    return share(summary.total.occluded, summary.total.rays);
}

double BakeReport::back_hit_share() const {
    return share(summary.total.back_hits, summary.total.rays);
}

ordered_json report_json(const BakeReport& report) {
    const PoseStatistics& total = report.summary.total;
    ordered_json json;
    json["bake"] = report.bake.string();
    json["num_vertices"] = report.num_vertices;
    json["num_triangles"] = report.num_triangles;
    json["num_poses"] = report.num_poses;
    if (!report.floor.empty()) json["floor"] = report.floor;
    if (report.still_vertices > 0) {
        json["scenery_vertices"] = report.still_vertices;
        json["scenery_triangles"] = report.still_triangles;
    }
    cli::add_root_motion(json, report.root_motion);
    json["poses_baked"] = report.summary.baked;
    json["poses_resumed"] = report.summary.resumed;
    json["bands"] = report.options.bands;
    json["rays"] = report.options.rays;
    if (report.options.transfer_error > 0.0) {
        json["transfer_error"] = report.options.transfer_error;
        json["vertices_above_transfer_error"] = total.above_target;
    }
    json["bounces"] = report.options.bounces;
    json["channels"] = report.channels;
    json["rays_traced"] = total.rays;
    json["rays_blocked"] = total.occluded;
    json["vertices_without_normal"] = total.zero_normals;
    json["relative_noise"] = total.relative_noise();
    add_colours(json, report.vertex_colours);
    json["mesh"] = mesh_json(report.topology, total.mesh);
    json["mesh"]["inward_parts"] = report.num_inward;
    for (const StillMeshReport& mesh : report.still_meshes) {
        ordered_json& entry = json["static_mesh"].emplace_back();
        entry["file"] = mesh.file;
        add_colours(entry, mesh.vertex_colours);
        entry.update(mesh_json(mesh.topology, mesh.pose));
        entry["inward_parts"] = mesh.num_inward;
    }
    return json;
}

std::string report_text(const BakeReport& report) {
    const PoseStatistics& total = report.summary.total;
    std::string text = fmt::format(
        "{}: {} vertices, {} triangles, poses {}-{} of {} ({} baked, {} found), {} bands\n",
        report.bake.string(), report.num_vertices, report.num_triangles, report.first_pose,
        report.last_pose, report.num_poses, report.summary.baked, report.summary.resumed,
        report.options.bands);
    const double noise = total.relative_noise();
    text += total.rays == 0
                ? "  no rays traced"
                : fmt::format("  {:.0f} rays per vertex, {:.1f} % occluded",
                              report.rays_per_vertex(), 100.0 * report.occluded_share());
    text += std::isnan(noise)
                ? "; no light reaches any vertex\n"
                : fmt::format("; estimated noise {:.2f} % of the transfer\n", 100.0 * noise);
    text += noise_target_text(report) + bounces_text(report) + surroundings_text(report);
    text += root_motion_text(report.root_motion);
    text += colours_text(report.vertex_colours, "");
    for (const StillMeshReport& mesh : report.still_meshes) {
        text += colours_text(mesh.vertex_colours, " of " + mesh.file);
    }
    if (total.zero_normals > 0) {
        text += fmt::format("  {} vertices (over all poses) have no normal; their transfer is 0\n",
                            total.zero_normals);
    }
    return text;
}

}  // namespace paim
