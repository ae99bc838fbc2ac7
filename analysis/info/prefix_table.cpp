// The prefixes of a .paim that can be played, with their errors.
#include "analysis/info/prefix_table.h"

#include <fmt/format.h>

#include <optional>

#include "paim/format/paim/paim_read.h"
#include "paim/format/paim/paim_write.h"
#include "paim/format/paim/prefixes.h"
#include "paim/metrics/prefix_error.h"

namespace paim {

using nlohmann::ordered_json;

namespace {

// Of long lists so many rows are shown, the first and the last among them.
constexpr size_t kMaxRows = 20;

std::optional<ErrorStatement> find_statement(const Asset& asset,
                                             const std::filesystem::path& path) {
    if (!ordered_json::parse(asset.provenance_json).contains("measured")) return {};
    return read_error_statement(asset, path);
}

}  // namespace

ordered_json describe_prefixes(const std::filesystem::path& path) {
    const Asset asset = read_paim(path);
    const PrefixErrors errors = prefix_errors(asset.moving(), find_statement(asset, path));
    const uint64_t size_bytes = std::filesystem::file_size(path);
    ordered_json json;
    json["file"] = path.string();
    json["size_bytes"] = size_bytes;
    json["light_spectrum"] = errors.band_power;
    json["transfer_error_of_whole_file"] = errors.transfer_stated ? "stated" : "unknown";
    json["position_rms_of_whole_file"] = errors.position_stated ? "stated" : "unknown";
    json["prefixes"] = ordered_json::array();
    for (const Prefix& prefix : read_prefixes(path)) {
        // A file may have more component sections than META counts.
        const auto kg =
            std::min(prefix.geometry_components, asset.moving().positions.num_components);
        const auto kt =
            std::min(prefix.transfer_components, asset.moving().transfer->matrix.num_components);
        json["prefixes"].push_back({{"size_bytes", prefix.size_bytes},
                                    {"share_of_file", static_cast<double>(prefix.size_bytes) /
                                                          static_cast<double>(size_bytes)},
                                    {"geometry_components", kg},
                                    {"transfer_components", kt},
                                    {"transfer_error", errors.transfer[kt]},
                                    {"position_rms", errors.position_rms[kg]}});
    }
    return json;
}

std::string prefixes_as_text(const ordered_json& description) {
    const ordered_json& prefixes = description["prefixes"];
    std::string text = fmt::format("{:>12}{:>9}{:>10}{:>10}{:>16}{:>14}\n", "bytes", "of file",
                                   "geometry", "transfer", "transfer error", "position RMS");
    const size_t num_rows = std::min(prefixes.size(), kMaxRows);
    for (size_t row = 0; row < num_rows; ++row) {
        const size_t last = prefixes.size() - 1;
        const ordered_json& prefix = prefixes[num_rows > 1 ? row * last / (num_rows - 1) : 0];
        text += fmt::format(
            "{:>12}{:>7.1f} %{:>10}{:>10}{:>14.3g} %{:>14.4g}\n",
            prefix["size_bytes"].get<uint64_t>(), 100.0 * prefix["share_of_file"].get<double>(),
            prefix["geometry_components"].get<uint32_t>(),
            prefix["transfer_components"].get<uint32_t>(),
            100.0 * prefix["transfer_error"].get<double>(), prefix["position_rms"].get<double>());
    }
    if (prefixes.size() > num_rows) {
        text += fmt::format("{} of {} prefixes; --json has all.\n", num_rows, prefixes.size());
    }
    const auto note = [&](const char* key, const char* what) {
        if (description[key] == "stated") return;
        text += fmt::format(
            "The file states no {}: the column has only what the missing components cost.\n", what);
    };
    note("transfer_error_of_whole_file", "error of its transfer under a light that has a name");
    note("position_rms_of_whole_file", "RMS distance of its positions");
    text +=
        fmt::format("Transfer errors are under the light spectrum {}, distances in scene units.\n",
                    description["light_spectrum"].get<std::string>());
    return text;
}

}  // namespace paim
