// The glossy reflection of a mesh, from its material libraries and from options.
// Based on: Alias Wavefront, The MTL file format, 1995; Exocortex, Physically-Based Rendering
//           Extensions of MTL, 2015
#pragma once

#include <cstdint>
#include <map>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "compressor/io/obj_libraries.h"
#include "compressor/io/obj_scan.h"
#include "paim/mesh/materials.h"
#include "paim/mesh/topology.h"

namespace paim {

// What the options say.
struct GlossChoice {
    bool from_libraries = false;  // whether Ks, Ns, Pr and Pm are read
    // Gloss of one material, or of the whole mesh.
    struct Override {
        std::string material;  // its name; empty: the whole mesh
        std::string brdf;      // as Brdf::text() writes it; empty: matte
    };
    // They count before libraries, one of a material before one of the mesh, the last of the same
    // before others.
    std::vector<Override> overrides;

    bool names_materials() const;
};

// "SPEC" or "NAME=SPEC". SPEC is "matte" or what parse_brdf() reads.
// Error (usage), naming the option --material: anything else.
GlossChoice::Override parse_gloss_override(const std::string& text);

// The gloss that the libraries give. A material with Pr is `cook-torrance`: its roughness is Pr,
// and its reflection at normal incidence F0 = 0.04 · (1 − Pm) + Kd · Pm; of its Kd the share 1 − Pm
// stays diffuse (set_diffuse_shares()). Any other with Ks above 0, Ns and no illum below 2 is `phong` of the exponent Ns.
// ks is the largest channel of F0 or Ks, and the tint F0 or Ks divided by it.
// warnings   gets a line if values were clamped to the range of the BRDF, and one if materials have
//            Pm without Pr, which does not count
// returns    per material of the libraries; an empty brdf: matte
std::vector<GlossMaterial> gloss_of_libraries(const std::string& name,
                                              const ObjLibraries& libraries,
                                              std::vector<std::string>& warnings);

// Sets the diffuse shares of the materials whose gloss is that of the libraries. A material whose gloss
// an option sets keeps the whole of its Kd.
// of_library  gloss_of_libraries(); empty: they are not read
void set_diffuse_shares(const GlossChoice& choice, const ObjScan& scan,
                        std::span<const GlossMaterial> of_library, ObjLibraries& libraries);

// How many materials of faces are glossy in the libraries, and the name of the first.
struct GlossyMaterials {
    size_t number = 0;
    std::string first;
};
GlossyMaterials count_glossy(const ObjScan& scan, const ObjLibraries& libraries);

struct FoundGloss {
    Materials materials;
    // By the number of a name in the scan, or -1: 0, or m for materials.glossy[m − 1]. Names of
    // triangles, all of them.
    std::map<int32_t, uint16_t> of_name;
};

// name         of the OBJ file, for messages
// of_library   gloss_of_libraries(); empty: they are not read
// polygons     [F] the face of the file that each triangle is of
// positions    [V] of the first pose
// Error (usage) if an override names a material that the file does not use.
FoundGloss find_gloss(const std::string& name, const GlossChoice& choice, const ObjScan& scan,
                      const ObjLibraries& libraries, std::span<const GlossMaterial> of_library,
                      const Topology& topology, std::span<const uint32_t> polygons,
                      std::span<const Vec3f> positions);

}  // namespace paim
