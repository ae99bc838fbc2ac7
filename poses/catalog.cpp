// The table of sequences.
#include "poses/catalog.h"

#include <array>
#include <string>

#include "paim/base/error.h"
#include "poses/octopus.h"
#include "poses/shapes.h"

namespace paim::poses {

std::span<const CatalogEntry> catalog() {
    static constexpr std::array<CatalogEntry, 6> kEntries{{
        {"octopus", "a coral octopus, its arms curling in travelling waves; exactly V vertices",
         kMinOctopusVertices, kMaxOctopusVertices, true, make_octopus_sequence},
        {"sphere", "closed sphere, radius 0.75 to 1.25: nothing is shadowed", kMinShapeVertices,
         kMaxShapeVertices, false, make_sphere_sequence},
        {"box", "closed cube of side 2, turning: nothing is shadowed", kMinShapeVertices,
         kMaxShapeVertices, false, make_box_sequence},
        {"plates", "two facing squares of side 2, distance 0.5 to 1.5: a known form factor",
         kMinShapeVertices, kMaxShapeVertices, false, make_plates_sequence},
        {"cavity", "the inside of a closed cube, turning: no vertex sees the sky",
         kMinShapeVertices, kMaxShapeVertices, false, make_cavity_sequence},
        {"bowl", "an open hemisphere, single sheet facing inwards: every vertex sees half its sky",
         kMinShapeVertices, kMaxShapeVertices, false, make_bowl_sequence},
    }};
    return kEntries;
}

const CatalogEntry& find_sequence(std::string_view name) {
    std::string known;
    for (const CatalogEntry& entry : catalog()) {
        if (entry.name == name) return entry;
        known += (known.empty() ? "" : ", ") + std::string(entry.name);
    }
    throw_usage("NAME: expected one of {}, got '{}'", known, name);
}

}  // namespace paim::poses
