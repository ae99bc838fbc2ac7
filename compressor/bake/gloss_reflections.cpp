// The reflections of the glossy materials of all meshes.
#include "compressor/bake/gloss_reflections.h"

#include <algorithm>
#include <set>

#include "compressor/material/brdfs.h"
#include "compressor/material/open_gloss.h"

namespace paim {

namespace {

std::set<std::string> brdfs_of(const std::vector<const Materials*>& meshes) {
    std::set<std::string> brdfs;
    for (const Materials* materials : meshes) {
        for (const GlossMaterial& material : materials->glossy) brdfs.insert(material.brdf);
    }
    return brdfs;
}

}  // namespace

GlossReflections::GlossReflections(const TransferLayout& layout,
                                   std::vector<const Materials*> meshes) {
    for (const std::string& text : brdfs_of(meshes)) {
        ExitFunctions functions(*parse_brdf(text), static_cast<int>(layout.out_bands));
        std::vector<double> open = open_gloss(functions, static_cast<int>(layout.in_bands));
        by_brdf_.emplace(text, GlossReflection{std::move(functions), std::move(open)});
    }
}

GlossEnergies gloss_energies(const std::vector<const Materials*>& meshes, uint32_t most_bands) {
    GlossEnergies energies;
    for (const std::string& text : brdfs_of(meshes)) {
        energies.emplace(text, gloss_energy(*parse_brdf(text), most_bands));
    }
    return energies;
}

TransferLayout choose_gloss_layout(const GlossEnergies& energies, uint32_t in_bands,
                                   uint32_t out_bands, uint32_t channels) {
    GlossBands bands{in_bands, out_bands};
    for (const auto& [brdf, energy] : energies) {
        const GlossBands needed = choose_gloss_bands(energy);
        if (in_bands == 0) bands.in = std::max(bands.in, needed.in);
        if (out_bands == 0) bands.out = std::max(bands.out, needed.out);
    }
    return {TransferKind::glossy_in_pose, bands.in, channels, bands.out};
}

bool has_coloured_tint(const Materials& materials) {
    return std::any_of(materials.glossy.begin(), materials.glossy.end(), [](const auto& material) {
        const Vec3f& tint = material.tint;
        return tint.x() != tint.y() || tint.y() != tint.z();
    });
}

}  // namespace paim
