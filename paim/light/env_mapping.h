// How the pixels of an environment map lie on the sphere, and which way a file means.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "paim/image/exr.h"

namespace paim {

// docs/conventions.md defines each.
enum class EnvMapping {
    automatic,  // what the file says, or what its size says
    latlong,    // latitude and longitude
    cube,       // six faces above each other, in OpenEXR's order
    angular,    // a square light probe: angle from the centre ∝ distance from the centre
};

// The names on command lines and in reports.
std::vector<std::pair<std::string, EnvMapping>> env_mapping_names();
std::string env_mapping_name(EnvMapping mapping);

struct MappingChoice {
    EnvMapping mapping;                // not automatic
    std::string reason;                // what decided: "the option", "attribute envmap" …
    std::vector<std::string> notes{};  // sentences for the user, without the name of the file
};

// The mapping of a file.
// wanted            by the user
// black_outside     whether a square image is black outside of its inscribed circle, as light
//                   probes are; called where it matters
// Errors (bad input): a cube map that is not N x 6N pixels, an angular map that is not square. They
// do not name the file.
MappingChoice choose_mapping(const ExrHeader& header, EnvMapping wanted,
                             const std::function<bool()>& black_outside);

}  // namespace paim
