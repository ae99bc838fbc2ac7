// How many rays a bake gets where --max-error decides.
#include "compressor/chosen_rays.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "paim/format/bake/bake_directory.h"
#include "paim/format/bake/bake_manifest.h"
#include "paim/format/bake/bake_removal.h"

namespace paim {

uint32_t pilot_rays(double transfer_error) {
    // 64 rays leave 3.8 to 4.4 % in sequences of 21 to 73 poses, and errors fall as rays^-0.62.
    // With fewer, components that matter do not stand out from noise, and errors are understated
    // (docs/results/noise.md).
    constexpr double kUsualError = 0.042, kUsualRays = 64.0, kPower = 0.62;
    constexpr double kLeast = 64.0, kMost = 1024.0;
    constexpr double kShareOfRays = 0.25;
    constexpr double kPackets = 32.0;  // one packet of rays a half
    const double usual = kUsualRays * std::pow(kUsualError / transfer_error, 1.0 / kPower);
    const double rays = kPackets * std::round(kShareOfRays * usual / kPackets);
    return static_cast<uint32_t>(std::clamp(rays, kLeast, kMost));
}

std::optional<uint32_t> rays_of_begun_bake(const std::filesystem::path& directory) {
    if (!is_bake(directory)) return std::nullopt;
    const uint32_t rays = read_manifest(directory / kManifestName).rays;
    const std::filesystem::directory_iterator entries(directory);
    const bool has_poses = std::any_of(begin(entries), end(entries), [](const auto& entry) {
        return entry.path().filename().string().starts_with("pose_");
    });
    return has_poses ? std::optional(rays) : std::nullopt;
}

void remove_bake_of_other_rays(const std::filesystem::path& directory, uint32_t rays) {
    if (!is_bake(directory)) return;
    if (read_manifest(directory / kManifestName).rays != rays) remove_bake(directory);
}

bool is_foreign_directory(const std::filesystem::path& directory) {
    return std::filesystem::exists(directory) && !std::filesystem::is_empty(directory) &&
           !is_bake(directory);
}

std::string chosen_rays_note(uint32_t rays, uint32_t pilot_rays, const EncodeTarget& target,
                             const EncodeProblem& pilot) {
    const bool is_enough = rays <= pilot_rays;
    std::string text = fmt::format(
        "{}{} rays a vertex {} for an error of {:.3g} %: once encoded, {} leave {:.3g} % at best",
        is_enough ? "" : "about ", std::max(rays, pilot_rays), is_enough ? "do" : "should do",
        100.0 * *target.transfer_error, is_enough ? "they" : fmt::to_string(pilot_rays),
        100.0 * pilot.least_error());
    if (target.vertex_error) {
        text += fmt::format(" and {:.3g} % at the worst vertex, where {:.3g} % is asked for",
                            100.0 * pilot.best_achievable.transfer.worst_vertex_error_to_bake,
                            100.0 * *target.vertex_error);
    }
    return text;
}

}  // namespace paim
