// Environment maps as they come: the one way in which tools read a light from a file.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "paim/image/exr.h"
#include "paim/light/env_mapping.h"
#include "paim/light/environment.h"

namespace paim {

struct LoadedLight {
    EnvironmentLight light;
    ExrHeader header;
    MappingChoice mapping;
    bool converted_colours = false;  // from the header's chromaticities to Rec. 709
    // What was assumed, and what was not used: sentences without the name of the file.
    std::vector<std::string> notes;
};

// The largest lat-long map that is kept. Larger ones are averaged down row by row while they are
// read, weighted by solid angle: the light of each part of the sphere stays, and its place moves by
// half a pixel, 0.04°, at most. So memory is bounded: about 150 MB for a file of any size within the
// limits.
constexpr int kMaxMapWidth = 4096;
constexpr int kMaxMapHeight = 2048;

// Reads an OpenEXR image as light: finds the mapping (choose_mapping()), converts cube maps and
// angular maps to lat-long, and colours to Rec. 709.
// Errors (bad input) name the file: those of read_exr(), choose_mapping() and RadianceCheck.
LoadedLight load_light(const std::filesystem::path& path,
                       EnvMapping mapping = EnvMapping::automatic, const ExrLimits& limits = {});

}  // namespace paim
