// The report of paim-compress about a file of diffuse and glossy transfer, as text and as JSON.
#pragma once

#include <fmt/format.h>

#include <filesystem>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>

#include "paim/metrics/frame_error.h"
#include "paim/metrics/rates.h"

namespace paim {

// Report  EncodeReport or TargetReport
template <typename Report>
struct GlossReport {
    std::filesystem::path paim;
    uint64_t size_bytes = 0;  // of the file of both
    uint32_t num_vertices = 0, num_poses = 0;
    Report diffuse, gloss;  // of files of one kind of transfer each, with the positions
    FrameError frames;      // of the gloss (metrics/frame_error.h)
    // Of the gloss, with that of its frames, where it was measured.
    std::optional<double> gloss_error;
};

// The members of the diffuse report, with the size of the file of both, and those of the gloss as the
// member `gloss`.
template <typename Report>
nlohmann::ordered_json report_json(const GlossReport<Report>& report) {
    nlohmann::ordered_json json = report_json(report.diffuse);
    json["paim"] = report.paim.string();
    json["size_bytes"] = report.size_bytes;
    json["bits_per_vertex_per_pose"] =
        bits_per_vertex_per_pose(report.size_bytes, report.num_vertices, report.num_poses);
    json["gloss"] = report_json(report.gloss);
    json["gloss"].erase("paim");
    json["gloss"]["frames"] = {{"relative_rms", report.frames.relative_rms},
                               {"worst_row", report.frames.worst_row}};
    if (report.gloss_error) json["gloss"]["error_with_frames"] = *report.gloss_error;
    return json;
}

// Lines, each with a line feed.
template <typename Report>
std::string report_text(const GlossReport<Report>& report) {
    return fmt::format(
               "{}: {:.1f} kB, {:.2f} bits per vertex and pose, with gloss\n", report.paim.string(),
               static_cast<double>(report.size_bytes) / 1e3,
               bits_per_vertex_per_pose(report.size_bytes, report.num_vertices, report.num_poses)) +
           report_text(report.diffuse) + gloss_text(report.gloss) +
           fmt::format(
               "  frames of the gloss, from decoded positions: {:.3g} %, worst row {:.3g} %{}\n",
               100.0 * report.frames.relative_rms, 100.0 * report.frames.worst_row,
               report.gloss_error
                   ? fmt::format("; with the coefficients {:.3g} %", 100.0 * *report.gloss_error)
                   : "");
}

}  // namespace paim
