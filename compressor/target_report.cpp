// The report of paim-compress about a file that meets a target.
#include "compressor/target_report.h"

#include <fmt/format.h>

#include <cmath>

#include "compressor/encode/search/transfer_encoder.h"
#include "compressor/encode_report.h"
#include "paim/metrics/rates.h"

namespace paim {

using nlohmann::ordered_json;

namespace {

// The columns of codecs that choose numbers of their own, a candidate's or the heading's.
// text_of  what a column says of an encoder
template <typename TextOf>
std::string codec_columns(const TextOf& text_of) {
    std::string columns;
    for (const TransferEncoderType& type : transfer_encoders()) {
        const std::string_view heading = type.words.heading;
        if (!heading.empty()) columns += fmt::format("  {:>{}}", text_of(type), heading.size());
    }
    return columns;
}

// "64 x 8", or "-" in the columns of other codecs.
std::string numbers_text(const Candidate& candidate, const TransferEncoderType& type) {
    if (candidate.codec != type.codec) return "-";
    std::string text;
    for (const CodecNumber& number : candidate.numbers) {
        text += fmt::format("{}{}", text.empty() ? "" : " x ", number.value);
    }
    return text;
}

std::string candidates_text(const std::vector<Candidate>& candidates) {
    std::string text =
        fmt::format("    codec  components{}  transfer kB  multiply-adds per vertex\n",
                    codec_columns([](const auto& type) { return type.words.heading; }));
    for (const Candidate& candidate : candidates) {
        text += fmt::format(
            "  {} {:<5}  {:>10}{}  {:>11.1f}  {:>24}\n", candidate.chosen ? '>' : ' ',
            candidate.codec, candidate.components,
            codec_columns([&](const auto& type) { return numbers_text(candidate, type); }),
            static_cast<double>(candidate.bytes) / 1e3, candidate.multiply_adds);
    }
    return text;
}

// With the numbers of every codec; 0 where a codec has none of that name.
ordered_json candidate_json(const Candidate& candidate) {
    ordered_json json;
    json["codec"] = candidate.codec;
    json["components"] = candidate.components;
    for (const TransferEncoderType& type : transfer_encoders()) {
        for (const char* const name : type.words.numbers) json[name] = candidate.number(name);
    }
    json["transfer_bytes"] = candidate.bytes;
    json["multiply_adds"] = candidate.multiply_adds;
    json["chosen"] = candidate.chosen;
    return json;
}

std::string transfer_text(const TargetSummary& summary) {
    const TransferError& transfer = summary.error.transfer;
    return fmt::format(
        "  transfer: {:.3g} % measured, {:.3g} % allowed, {:.2g} % at best with these components; "
        "from the bake: worst vertex {:.3g} %{}, worst pose {:.3g} %\n",
        100.0 * transfer.total(), 100.0 * summary.targets.transfer, 100.0 * summary.best_achievable,
        100.0 * transfer.worst_vertex_error_to_bake,
        std::isfinite(summary.targets.worst_vertex)
            ? fmt::format(" ({:.3g} % allowed)", 100.0 * summary.targets.worst_vertex)
            : "",
        100.0 * transfer.worst_pose_error_to_bake);
}

std::string geometry_text(const TargetSummary& summary) {
    const GeometryError& geometry = summary.error.geometry;
    return (summary.float_positions
                ? "  positions are floats, as no integers of 16 bits meet these targets\n"
                : "") +
           fmt::format(
               "  geometry: {} components, RMS distance {:.3g} measured, {:.3g} allowed ({:.2g} % of the "
               "diagonal), worst {:.3g}; KG {:.3g} %, E_RMS {:.3g}\n",
               summary.geometry_components, geometry.rms(), summary.targets.surface.distance,
               100.0 * geometry.relative_rms(), geometry.worst(), geometry.kg_error(),
               geometry.e_rms()) +
           fmt::format(
               "  shape, worst piece of the mesh: STED {:.3g} % measured, {:.3g} % allowed; face "
               "normals turn by {:.3g} degrees on average, {:.3g} allowed\n",
               100.0 * summary.error.shape.worst.sted(), 100.0 * summary.targets.surface.sted,
               summary.error.shape.worst.normal_angle_deg,
               summary.targets.surface.normal_angle_deg);
}

std::string still_mesh_text(const MeshError& still_mesh) {
    return fmt::format(
        "  still meshes: transfer {:.3g} % measured, worst vertex {:.3g} %; RMS distance {:.3g}, worst "
        "{:.3g}; STED {:.3g} %, face normals {:.3g} degrees\n",
        100.0 * still_mesh.transfer.total(), 100.0 * still_mesh.transfer.worst_vertex_error_to_bake,
        still_mesh.geometry.rms(), still_mesh.geometry.worst(),
        100.0 * still_mesh.shape.worst.sted(), still_mesh.shape.worst.normal_angle_deg);
}

}  // namespace

ordered_json report_json(const TargetReport& report) {
    const TargetSummary& summary = report.summary;
    ordered_json json;
    json["paim"] = report.paim.string();
    json["num_vertices"] = summary.num_vertices;
    json["num_poses"] = summary.num_poses;
    const Candidate& chosen = summary.chosen();
    json["codec"] = chosen.codec;
    json["bands"] = chosen.bands;
    json["geometry_components"] = summary.geometry_components;
    json["transfer_components"] = chosen.components;
    for (const CodecNumber& number : chosen.numbers) json[number.name] = number.value;
    json["size_bytes"] = summary.size_bytes;
    json["bits_per_vertex_per_pose"] =
        bits_per_vertex_per_pose(summary.size_bytes, summary.num_vertices, summary.num_poses);
    json["multiply_adds"] = chosen.multiply_adds;
    json["transfer_target"] = summary.targets.transfer;
    if (std::isfinite(summary.targets.worst_vertex)) {
        json["vertex_target"] = summary.targets.worst_vertex;
    }
    json["geometry_target"] = summary.targets.surface.distance;
    json["sted_target"] = summary.targets.surface.sted;
    json["normal_angle_target_deg"] = summary.targets.surface.normal_angle_deg;
    json["best_transfer_error"] = summary.best_achievable;
    json["measured"] = errors_json(summary.error);
    json["candidates"] = ordered_json::array();
    for (const Candidate& candidate : summary.candidates) {
        json["candidates"].push_back(candidate_json(candidate));
    }
    return json;
}

namespace {

std::string report_text(const TargetReport& report, bool has_positions) {
    const TargetSummary& summary = report.summary;
    std::string text = fmt::format(
        "{}: {:.1f} kB, {:.2f} bits per vertex and pose{}\n", report.paim.string(),
        static_cast<double>(summary.size_bytes) / 1e3,
        bits_per_vertex_per_pose(summary.size_bytes, summary.num_vertices, summary.num_poses),
        has_positions ? "" : " by itself");
    text += candidates_text(summary.candidates) + transfer_text(summary);
    if (has_positions) text += geometry_text(summary);
    if (summary.error.still && has_positions) text += still_mesh_text(*summary.error.still);
    return text;
}

}  // namespace

std::string report_text(const TargetReport& report) {
    return report_text(report, true);
}

std::string gloss_text(const TargetReport& report) {
    return report_text(report, false);
}

}  // namespace paim
