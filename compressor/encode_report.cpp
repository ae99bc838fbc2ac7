// The report of paim-compress about an encoding.
#include "compressor/encode_report.h"

#include <fmt/format.h>

namespace paim {

using nlohmann::ordered_json;

namespace {

// The members of geometry or of transfer.
ordered_json part_json(uint32_t components, uint32_t rank, double theory, double energy) {
    ordered_json json;
    json["components"] = components;
    json["rank"] = rank;
    json["theory_error"] = theory;
    json["energy_error"] = energy;
    return json;
}

std::string part_text(const char* part, uint32_t components, uint32_t rank, double theory,
                      double energy) {
    // A body that does not change but for rounding, or transfer that does not but for noise.
    if (components == 0 && rank > 0) {
        return fmt::format("  {}: 0 of {} components: every pose is the mean\n", part, rank);
    }
    return fmt::format(
        "  {}: {} of {} components, energy error {:.3g} %, theoretical error {:.3g} %\n", part,
        components, rank, 100.0 * energy, 100.0 * theory);
}

}  // namespace

ordered_json errors_json(const AssetError& error) {
    ordered_json json;
    for (const NamedError& named : named_errors(error)) json[named.name] = named.value;
    return json;
}

bool EncodeReport::more_rays_would_help() const {
    return summary.expected_noise_error > summary.expected_truncation_error;
}

ordered_json report_json(const EncodeReport& report) {
    const EncodeSummary& summary = report.summary;
    ordered_json json;
    json["paim"] = report.paim.string();
    json["num_vertices"] = report.num_vertices;
    json["num_poses"] = report.num_poses;
    json["bands"] = summary.bands;
    json["geometry"] = part_json(summary.geometry_components, summary.geometry_rank,
                                 summary.geometry_theory_error, summary.geometry_energy_error);
    ordered_json transfer = part_json(summary.transfer_components, summary.transfer_rank,
                                      summary.transfer_theory_error, summary.transfer_energy_error);
    transfer["above_noise"] = summary.transfer_above_noise;
    transfer["signal_error"] = summary.transfer_signal_error;
    transfer["shrunk"] = summary.shrunk;
    transfer["expected_error"] = summary.expected_error();
    transfer["expected_truncation_error"] = summary.expected_truncation_error;
    transfer["expected_noise_error"] = summary.expected_noise_error;
    transfer["more_rays_would_help"] = report.more_rays_would_help();
    json["transfer"] = std::move(transfer);
    json["size_bytes"] = summary.size_bytes;
    if (summary.measured) json["measured"] = errors_json(*summary.measured);
    return json;
}

std::string report_text(const EncodeReport& report) {
    const EncodeSummary& summary = report.summary;
    std::string text = fmt::format("{}: {:.2f} MB, {} bands\n", report.paim.string(),
                                   static_cast<double>(summary.size_bytes) / 1e6, summary.bands);
    text += part_text("geometry", summary.geometry_components, summary.geometry_rank,
                      summary.geometry_theory_error, summary.geometry_energy_error);
    text += part_text("transfer", summary.transfer_components, summary.transfer_rank,
                      summary.transfer_theory_error, summary.transfer_energy_error);
    text += fmt::format(
        "  expected error of the transfer: {:.2g} % ({:.2g} % dropped components, {:.2g} % bake "
        "noise{})\n",
        100.0 * summary.expected_error(), 100.0 * summary.expected_truncation_error,
        100.0 * summary.expected_noise_error, summary.shrunk ? ", shrunk" : "");
    if (!summary.measured) return text;
    const GeometryError& geometry = summary.measured->geometry;
    text += fmt::format(
        "  measured: transfer {:.3g} %, RMS distance {:.3g} ({:.2g} % of the diagonal)\n",
        100.0 * summary.measured->transfer.total(), geometry.rms(),
        100.0 * geometry.relative_rms());
    return text;
}

}  // namespace paim
