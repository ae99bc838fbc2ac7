// The reflections of the glossy materials of all meshes, ready for the sums over rays.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "compressor/material/exit_functions.h"
#include "compressor/material/gloss_bands.h"
#include "paim/mesh/materials.h"
#include "paim/transfer/layout.h"

namespace paim {

struct GlossReflection {
    ExitFunctions functions;
    std::vector<double> open;  // [K][C], open_gloss()
};

// One for each BRDF, which is parsed once. Errors: those of parse_brdf().
class GlossReflections {
  public:
    GlossReflections() = default;
    GlossReflections(const TransferLayout& layout, std::vector<const Materials*> meshes);

    bool empty() const { return by_brdf_.empty(); }
    // Of a BRDF in words, as the materials have it.
    const GlossReflection& of(const std::string& brdf) const { return by_brdf_.at(brdf); }

  private:
    std::map<std::string, GlossReflection> by_brdf_;
};

// The energy of the reflection of each BRDF of the materials (material/gloss_bands.h), up to this many
// bands; by the BRDF in words. Errors: those of parse_brdf().
using GlossEnergies = std::map<std::string, GlossEnergy>;
GlossEnergies gloss_energies(const std::vector<const Materials*>& meshes, uint32_t most_bands);

// The layout of the glossy transfer of all meshes, in the axes of the pose. Numbers of bands that are 0 are chosen for the
// material that needs most.
// energies  of at least one BRDF, up to as many bands as may be chosen
TransferLayout choose_gloss_layout(const GlossEnergies& energies, uint32_t in_bands,
                                   uint32_t out_bands, uint32_t channels);

// Whether any tint is not grey.
bool has_coloured_tint(const Materials& materials);

}  // namespace paim
