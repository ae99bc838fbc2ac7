// Which pictures errors are measured against.
#pragma once

#include <memory>
#include <string>

#include "analysis/reference/reference_pictures.h"
#include "analysis/reference/traced_pictures.h"

namespace paim {

enum class ReferenceKind {
    bake,           // all components and bands of the bake
    traced,         // light of the whole map, traced at the vertices
    traced_pixels,  // the same at every pixel
};

// A reference that was chosen. It keeps references to bake and stage.
struct Reference {
    ReferenceSource source;                   // keeps `traced`, too
    std::string name;                         // for captions: "the bake"
    std::shared_ptr<TracedReference> traced;  // nullptr: the bake
    bool rays_were_chosen = false;
};

// rays  of a traced reference, rounded up to a multiple of 4; 0: as many as take_enough_rays() finds
Reference make_reference(ReferenceKind kind, uint32_t rays, const BakeReader& bake,
                         const Stage& stage);

// What a person should know about the noise of a reference: where it is more than kNoiseOfError of
// the smallest visual error that was measured against it; empty if all is well.
// error  the smallest one under the light
std::string noise_note(const Reference& reference, const Stage& stage, size_t light, double noise,
                       double error);

}  // namespace paim
