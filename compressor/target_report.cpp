// What paim-compress says of a file that was made to meet a target.
#include "compressor/target_report.h"

#include <fmt/format.h>

#include "paim/metrics/rates.h"

namespace paim {

using nlohmann::ordered_json;

ordered_json target_json(const TargetSummary& summary) {
    ordered_json json;
    const Candidate& chosen = summary.chosen();
    json["codec"] = chosen.codec;
    json["bands"] = chosen.bands;
    json["geometry_components"] = summary.geometry_components;
    json["transfer_components"] = chosen.components;
    if (chosen.clusters > 0) {
        json["clusters"] = chosen.clusters;
        json["cluster_components"] = chosen.cluster_components;
    }
    json["size_bytes"] = summary.size_bytes;
    json["bits_per_vertex_per_pose"] =
        bits_per_vertex_per_pose(summary.size_bytes, summary.num_vertices, summary.num_poses);
    json["multiply_adds"] = chosen.multiply_adds;
    json["transfer_target"] = summary.transfer_target;
    json["geometry_target"] = summary.geometry_target;
    json["best_transfer_error"] = summary.best_achievable;
    for (const NamedError& error : named_errors(summary.error)) {
        json["measured"][error.name] = error.value;
    }
    json["candidates"] = ordered_json::array();
    for (const Candidate& candidate : summary.candidates) {
        json["candidates"].push_back({{"codec", candidate.codec},
                                      {"components", candidate.components},
                                      {"clusters", candidate.clusters},
                                      {"cluster_components", candidate.cluster_components},
                                      {"transfer_bytes", candidate.bytes},
                                      {"multiply_adds", candidate.multiply_adds},
                                      {"chosen", candidate.chosen}});
    }
    return json;
}

std::string target_text(const std::string& file, const TargetSummary& summary) {
    const TransferError& transfer = summary.error.transfer;
    const GeometryError& geometry = summary.error.geometry;
    std::string text = fmt::format(
        "{}: {:.1f} kB, {:.2f} bits a vertex and pose\n", file,
        static_cast<double>(summary.size_bytes) / 1e3,
        bits_per_vertex_per_pose(summary.size_bytes, summary.num_vertices, summary.num_poses));
    text += "    codec  components  clusters x components  transfer kB  multiply-adds a vertex\n";
    for (const Candidate& candidate : summary.candidates) {
        const std::string clusters =
            candidate.clusters == 0
                ? "-"
                : fmt::format("{} x {}", candidate.clusters, candidate.cluster_components);
        text += fmt::format("  {} {:<5}  {:>10}  {:>21}  {:>11.1f}  {:>22}\n",
                            candidate.chosen ? '>' : ' ', candidate.codec, candidate.components,
                            clusters, static_cast<double>(candidate.bytes) / 1e3,
                            candidate.multiply_adds);
    }
    text += fmt::format(
        "  transfer: {:.3g} % measured, {:.3g} % allowed, {:.2g} % at best with these components; "
        "from the bake: worst vertex {:.3g} %, "
        "worst pose {:.3g} %\n",
        100.0 * transfer.total(), 100.0 * summary.transfer_target, 100.0 * summary.best_achievable,
        100.0 * transfer.worst_vertex_deviation, 100.0 * transfer.worst_pose_deviation);
    text += fmt::format(
        "  geometry: {} components, RMS distance {:.3g} measured, {:.3g} allowed ({:.2g} % of the "
        "diagonal), worst {:.3g}; KG {:.3g} %, E_RMS {:.3g}\n",
        summary.geometry_components, geometry.rms(), summary.geometry_target,
        100.0 * geometry.relative_rms(), geometry.worst(), geometry.kg_error(), geometry.e_rms());
    if (!summary.error.still) return text;
    const MeshError& still = *summary.error.still;
    text += fmt::format(
        "  scenery: transfer {:.3g} % measured, worst vertex {:.3g} %; RMS distance {:.3g}, worst "
        "{:.3g}\n",
        100.0 * still.transfer.total(), 100.0 * still.transfer.worst_vertex_deviation,
        still.geometry.rms(), still.geometry.worst());
    return text;
}

}  // namespace paim
