// What glossy transfer will take, known before the bake.
#include "compressor/gloss_plan.h"

#include <fmt/format.h>

#include "compressor/bake/transfer_baker.h"
#include "compressor/encode/memory/memory_plan.h"
#include "compressor/material/brdfs.h"
#include "compressor/material/gloss_bands.h"

namespace paim {

std::optional<GlossPlan> plan_gloss(const BakeInput& input, const BakeOptions& options) {
    const PoseSource& poses = input.poses();
    const StillMesh& still_mesh = input.surroundings().still_mesh;
    const auto layout =
        TransferBaker::gloss_layout(options, poses.albedo(), still_mesh, poses.materials());
    if (!layout) return std::nullopt;
    return GlossPlan{*layout, glossy_rows(poses.topology(), poses.materials()).size()};
}

namespace {

std::string what_it_takes(const GlossPlan& plan, uint64_t num_poses) {
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

std::vector<std::string> gloss_notes(const GlossPlan& plan, const BakeInput& input,
                                     uint64_t num_poses) {
    const TransferLayout& layout = plan.layout;
    std::vector<std::string> notes{what_it_takes(plan, num_poses)};
    Materials all = input.poses().materials();
    all.append(input.surroundings().still_mesh.materials, 0, 0);
    for (const GlossMaterial& material : all.glossy) {
        const auto brdf = parse_brdf(material.brdf);
        const GlossBands bands = given_gloss_bands(*brdf, layout.in_bands, layout.out_bands);
        if (std::string note = gloss_bands_note(*brdf, bands); !note.empty()) {
            notes.push_back(std::move(note));
        }
    }
    return notes;
}

}  // namespace paim
