// What the surface of a mesh is made of: colours, gloss and images of its OBJ file.
#pragma once

#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "compressor/io/obj_gloss.h"
#include "compressor/io/obj_scan.h"
#include "compressor/io/vertex_colours.h"
#include "paim/mesh/materials.h"
#include "paim/mesh/texture.h"
#include "paim/mesh/topology.h"

namespace paim {

struct ObjSurfaceOptions {
    // Overrides the colours and materials of the file; linear, 0..1.
    std::optional<Vec3f> albedo;
    // What the colours of vertices are taken as.
    ColourCurve vertex_colours = ColourCurve::automatic;
    // False: images of materials are not read.
    bool textures = true;
    // Gloss of material libraries and of options.
    GlossChoice gloss;
};

// Whether the scan must have the materials of the file.
bool needs_materials(const ObjSurfaceOptions& options);

struct ObjSurface {
    Albedo albedo;
    VertexColours vertex_colours;
    Materials materials;
    Texture texture;
    // Whether a material of faces is glossy in the libraries. False if their gloss is not read.
    bool has_library_gloss = false;
    // Lines, each with the name of the file.
    std::vector<std::string> warnings;
    std::vector<std::string> notes;  // about what may well be meant
};

// The albedo is that of the options, else vertex colours, else materials (obj_albedo.h). Images count
// with materials, so that options and vertex colours take their place, too.
// file       of the first pose
// scan       of it; its colours are moved out
// exporter   that wrote the file and writes sRGB colours; or ""
// polygons   [F] the face of the scan that each triangle is of
// positions  [V] of the first pose
// Error (usage): the options name a material that the file has not.
ObjSurface read_surface(const std::filesystem::path& file, ObjScan& scan,
                        const std::string& exporter, const ObjSurfaceOptions& options,
                        const Topology& topology, std::span<const uint32_t> polygons,
                        std::span<const Vec3f> positions);

}  // namespace paim
