// What the surface of a mesh is made of.
#include "compressor/io/obj_surface.h"

#include <fmt/format.h>

#include <utility>

#include "compressor/io/obj_albedo.h"
#include "compressor/io/obj_libraries.h"
#include "compressor/io/obj_reflectance.h"
#include "compressor/io/obj_text.h"
#include "compressor/io/obj_texture.h"

namespace paim {

namespace {

// Whether the albedo comes from materials.
bool has_material_colours(const ObjSurfaceOptions& options, const ObjScan& scan) {
    return !options.albedo && !scan.has_colors;
}

bool needs_gloss(const GlossChoice& gloss) {
    return gloss.from_libraries || gloss.names_materials();
}

// How many materials of the libraries name an image, where they are not read.
void warn_of_unread_textures(const std::string& name, const ObjLibraries& libraries,
                             std::vector<std::string>& warnings) {
    size_t num_textures = 0;
    std::string texture;
    for (const ObjMaterial& material : libraries.materials) {
        if (!material.map) continue;
        if (num_textures++ == 0) texture = printable(material.map->file);
    }
    if (num_textures == 0) return;
    warnings.push_back(fmt::format("{}: textures are not read: map_Kd of {} materials, e.g. {}",
                                   name, num_textures, texture));
}

// Albedo and texture, where they come from materials. Returns the colours of the faces of the scan.
std::vector<Vec3d> find_material_colours(const std::string& name, const ObjScan& scan,
                                         const ObjSurfaceOptions& options,
                                         const ObjLibraries& libraries, const Topology& topology,
                                         std::span<const uint32_t> polygons, ObjSurface& surface) {
    std::vector<Vec3d> colours = colours_of_faces(name, scan, libraries, surface.warnings);
    if (!options.textures) {
        warn_of_unread_textures(name, libraries, surface.warnings);
    } else if (!colours.empty()) {
        surface.texture =
            read_texture(name, scan, libraries, topology, polygons, colours, surface.warnings);
    }
    surface.albedo = albedo_of_faces(scan, colours);
    return colours;
}

Albedo find_albedo(const std::string& name, ObjScan& scan, const std::string& exporter,
                   const ObjSurfaceOptions& options, ObjSurface& surface) {
    if (options.albedo) return {{*options.albedo}};
    const ColourCurve curve = options.vertex_colours;
    const bool is_automatic = curve == ColourCurve::automatic;
    const bool srgb = is_automatic ? !exporter.empty() : curve == ColourCurve::srgb;
    surface.vertex_colours = {true, srgb, !is_automatic, exporter};
    return albedo_of_colours(name, std::exchange(scan.colors, {}), srgb, surface.warnings);
}

// Notes gloss that nothing asks for: many exporters write some that nobody meant.
void note_unread_gloss(const std::string& name, const ObjScan& scan, const ObjLibraries& libraries,
                       ObjSurface& surface) {
    const GlossyMaterials glossy = count_glossy(scan, libraries);
    if (glossy.number == 0) return;
    surface.notes.push_back(fmt::format(
        "{}: {} materials are glossy, e.g. '{}', and baked as matte: --gloss takes their gloss, "
        "--material sets another",
        name, glossy.number, glossy.first));
}

}  // namespace

bool needs_materials(const ObjSurfaceOptions& options) {
    return !options.albedo || needs_gloss(options.gloss);
}

ObjSurface read_surface(const std::filesystem::path& file, ObjScan& scan,
                        const std::string& exporter, const ObjSurfaceOptions& options,
                        const Topology& topology, std::span<const uint32_t> polygons,
                        std::span<const Vec3f> positions) {
    const std::string name = file.string();
    const GlossChoice& choice = options.gloss;
    ObjSurface surface;
    ObjLibraries libraries;
    if (has_material_colours(options, scan) || needs_gloss(choice)) {
        libraries = read_obj_libraries(name, file.parent_path(), scan, choice.from_libraries);
        surface.warnings = std::move(libraries.warnings);
    }
    std::vector<GlossMaterial> gloss;
    if (choice.from_libraries) {
        gloss = gloss_of_libraries(name, libraries, surface.warnings);
        surface.has_library_gloss = count_glossy(scan, libraries).number > 0;
    }
    if (!choice.from_libraries && choice.overrides.empty()) {
        note_unread_gloss(name, scan, libraries, surface);
    }
    set_diffuse_shares(choice, scan, gloss, libraries);
    FoundGloss found =
        find_gloss(name, choice, scan, libraries, gloss, topology, polygons, positions);
    std::vector<Vec3d> colours;
    if (has_material_colours(options, scan)) {
        colours =
            find_material_colours(name, scan, options, libraries, topology, polygons, surface);
    } else {
        surface.albedo = find_albedo(name, scan, exporter, options, surface);
    }
    for (std::string& warning :
         reflectance_warnings(name, scan, libraries, found, colours, surface.albedo)) {
        surface.warnings.push_back(std::move(warning));
    }
    surface.materials = std::move(found.materials);
    return surface;
}

}  // namespace paim
