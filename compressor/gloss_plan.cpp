// What glossy transfer will be and take, known before the bake.
#include "compressor/gloss_plan.h"

#include <fmt/format.h>

#include <algorithm>

#include "compressor/bake/gloss_reflections.h"
#include "compressor/encode/memory/memory_plan.h"

namespace paim {

std::optional<GlossPlan> plan_gloss(const BakeInput& input, const BakeOptions& options) {
    const Materials& materials = input.poses().materials();
    const Materials& still_materials = input.surroundings().still_mesh.materials;
    if (materials.empty() && still_materials.empty()) return std::nullopt;
    const uint32_t in_bands = options.gloss_in_bands, out_bands = options.gloss_out_bands;
    const GlossEnergies energies =
        gloss_energies({&materials, &still_materials},
                       std::max({in_bands, out_bands, kMostChosenInBands, kMostChosenOutBands}));
    GlossPlan plan{
        choose_gloss_layout(energies, in_bands, out_bands, input.layout(options).channels)
            .in_frames(),
        glossy_rows(input.poses().topology(), materials).size(),
        glossy_rows(input.surroundings().still_mesh.topology, still_materials).size(),
        options.bounces};
    for (const auto& [brdf, energy] : energies) {
        const GlossBands bands =
            given_gloss_bands(energy, plan.layout.in_bands, plan.layout.out_bands);
        std::string note = gloss_bands_note(brdf, bands);
        if (!note.empty()) plan.left_out.push_back(std::move(note));
    }
    return plan;
}

uint64_t GlossPlan::memory_bytes() const {
    TransferLayout baked = layout;
    baked.kind = TransferKind::glossy_in_pose;
    const uint64_t floats = sizeof(float) * uint64_t{baked.num_planes()};
    const uint64_t poses = floats * num_rows, still = floats * num_still_rows;
    // Both halves, and one of them in frames while they are turned (gloss_to_frames.h).
    if (bounces == 0) {
        return (2 * floats + sizeof(float) * layout.num_planes()) *
               std::max(num_rows, num_still_rows);
    }
    // Both halves, twice: all light and the last bounce alone (glossy_bounces.h). What all meshes send
    // out in one half. Both halves of every bounce of the still meshes, which stay.
    const uint64_t of_still = 2 * bounces * still;
    return std::max(5 * poses + still, 5 * still) + of_still;
}

namespace {

std::string what_it_takes(const GlossPlan& plan, uint64_t num_poses) {
    if (plan.num_rows == 0 && plan.num_still_rows == 0) {
        return "gloss: no vertex has it: vertices have the material that most of their faces have";
    }
    if (plan.num_rows == 0) {
        return "gloss: no vertex of the poses is glossy, and the gloss of still meshes alone is not "
               "encoded: it is kept " +
               how_to_keep_still_gloss();
    }
    const TransferLayout& layout = plan.layout;
    return fmt::format(
        "gloss: {} vertices of {} coefficients ({} bands of light, {} of outgoing radiance, {} {}) "
        "take {} on disk for {} {} and {} of memory",
        plan.num_rows, layout.num_planes(), layout.in_bands, layout.out_bands, layout.channels,
        layout.channels == 1 ? "channel" : "channels",
        memory_text(plan.pose_file_bytes() * num_poses), num_poses,
        num_poses == 1 ? "pose" : "poses", memory_text(plan.memory_bytes()));
}

}  // namespace

std::string how_to_keep_still_gloss() {
    return "with --material phong:0,1, which makes the poses glossy and reflects nothing";
}

std::vector<std::string> gloss_notes(const GlossPlan& plan, uint64_t num_poses) {
    std::vector<std::string> notes{what_it_takes(plan, num_poses)};
    notes.insert(notes.end(), plan.left_out.begin(), plan.left_out.end());
    return notes;
}

}  // namespace paim
