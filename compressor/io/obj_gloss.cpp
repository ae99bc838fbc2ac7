// The glossy reflection of a mesh.
#include "compressor/io/obj_gloss.h"

#include <fmt/format.h>

#include <algorithm>
#include <memory>

#include "compressor/io/obj_text.h"
#include "compressor/io/vertex_materials.h"
#include "compressor/material/brdfs.h"
#include "paim/base/check.h"
#include "paim/base/error.h"

namespace paim {

namespace {

constexpr const char* kMatte = "matte";
// The ranges of the BRDFs (material/phong.h, material/cook_torrance.h).
constexpr double kLeastExponent = 1.0, kMostExponent = 10000.0;
constexpr double kLeastRoughness = 0.02, kMostRoughness = 1.0;
constexpr double kDielectric = 0.04;       // what all but metals reflect at normal incidence
constexpr double kFirstGlossyModel = 2.0;  // illum: 0 and 1 have no highlight

// Clamps, and counts numbers out of range.
class Clamp {
  public:
    double operator()(double value, double least, double most) {
        const double clamped = value > least ? std::min(value, most) : least;
        if (clamped != value) ++num_clamped_;
        return clamped;
    }
    Vec3d operator()(const Vec3d& color) {
        return {(*this)(color[0], 0.0, 1.0), (*this)(color[1], 0.0, 1.0),
                (*this)(color[2], 0.0, 1.0)};
    }
    size_t num_clamped() const { return num_clamped_; }

  private:
    size_t num_clamped_ = 0;
};

// The material whose reflection is `color`, which is not black, with one more number of the BRDF.
GlossMaterial material_of(const char* brdf, const Vec3d& color, double number) {
    const double ks = color.maxCoeff();
    const std::string spec = fmt::format("{}:{:.6g},{:.6g}", brdf, ks, number);
    return {parse_brdf(spec)->text(), (color / ks).cast<float>()};
}

Vec3d diffuse_of(const ObjMaterial& material) {
    return material.diffuse.value_or(Albedo().values[0].cast<double>());
}

// An empty brdf if the material is matte.
GlossMaterial gloss_of(const ObjMaterial& material, Clamp& clamp) {
    if (material.roughness) {
        const double metallic = clamp(material.metallic.value_or(0.0), 0.0, 1.0);
        const Vec3d kd = diffuse_of(material).cwiseMax(0.0).cwiseMin(1.0);
        const Vec3d f0 = Vec3d::Constant(kDielectric * (1.0 - metallic)) + kd * metallic;
        if (!(f0.maxCoeff() > 0.0)) return {};
        return material_of("cook-torrance", f0,
                           clamp(*material.roughness, kLeastRoughness, kMostRoughness));
    }
    if (!material.specular || !material.exponent) return {};
    if (material.illumination.value_or(kFirstGlossyModel) < kFirstGlossyModel) return {};
    if (!(material.specular->maxCoeff() > 0.0)) return {};
    return material_of("phong", clamp(*material.specular),
                       clamp(*material.exponent, kLeastExponent, kMostExponent));
}

// The gloss of a face's material; the names of materials are those of usemtl lines, or of the
// libraries where these differ.
class Chooser {
  public:
    Chooser(const GlossChoice& choice, const ObjScan& scan, const ObjLibraries& libraries,
            std::span<const GlossMaterial> of_library)
        : choice_(choice), scan_(scan), libraries_(libraries), of_library_(of_library) {}

    // named  index into the names of the scan, or -1
    GlossMaterial gloss(int32_t named) const {
        const GlossMaterial* found = nullptr;
        const ObjMaterial* const material = material_at(named);
        if (material != nullptr && !of_library_.empty()) {
            found = &of_library_[static_cast<size_t>(material - libraries_.materials.data())];
        }
        const GlossChoice::Override* const chosen = override_of(named);
        if (chosen != nullptr) return {chosen->brdf, Vec3f::Ones()};
        return found != nullptr ? *found : GlossMaterial{};
    }

    // The override that counts for a face's material, or nullptr: that of the library.
    const GlossChoice::Override* override_of(int32_t named) const {
        const GlossChoice::Override* chosen = nullptr;
        for (const GlossChoice::Override& entry : choice_.overrides) {
            const bool counts = entry.material.empty() ? chosen == nullptr || is_of_mesh(*chosen)
                                                       : has_name(named, entry.material);
            if (counts) chosen = &entry;
        }
        return chosen;
    }

    bool has_name(int32_t named, const std::string& name) const {
        if (named < 0) return false;
        const ObjMaterial* const material = material_at(named);
        return scan_.materials[static_cast<size_t>(named)] == name ||
               (material != nullptr && material->name == name);
    }

  private:
    static bool is_of_mesh(const GlossChoice::Override& entry) { return entry.material.empty(); }

    const ObjMaterial* material_at(int32_t named) const {
        return material_of_name(libraries_, named);
    }

    const GlossChoice& choice_;
    const ObjScan& scan_;
    const ObjLibraries& libraries_;
    std::span<const GlossMaterial> of_library_;
};

// The share of a material's Kd that stays diffuse next to the gloss of its library.
double diffuse_share(const ObjMaterial& material, const GlossMaterial& gloss) {
    if (gloss.brdf.empty() || !material.metallic || !material.roughness) return 1.0;
    return 1.0 - std::clamp(*material.metallic, 0.0, 1.0);
}

// Error if a name is none of the materials of faces.
void check_names(const std::string& name, const GlossChoice& choice, const ObjScan& scan,
                 const Chooser& chooser) {
    for (const GlossChoice::Override& entry : choice.overrides) {
        if (entry.material.empty()) continue;
        const auto has_name = [&](int32_t named) {
            return chooser.has_name(named, entry.material);
        };
        if (std::any_of(scan.face_materials.begin(), scan.face_materials.end(), has_name)) continue;
        constexpr size_t kMaxShown = 8;
        std::string names;
        for (size_t i = 0; i < std::min(kMaxShown, scan.materials.size()); ++i) {
            names += fmt::format("{}'{}'", i > 0 ? ", " : "", printable(scan.materials[i]));
        }
        if (scan.materials.size() > kMaxShown) names += ", …";
        throw_usage("--material: no face of {} has the material '{}', expected {}", name,
                    printable(entry.material),
                    names.empty() ? "none, as the file has no usemtl" : names);
    }
}

}  // namespace

bool GlossChoice::names_materials() const {
    return std::any_of(overrides.begin(), overrides.end(),
                       [](const Override& entry) { return !entry.material.empty(); });
}

GlossChoice::Override parse_gloss_override(const std::string& text) {
    const size_t equals = text.rfind('=');
    GlossChoice::Override entry;
    if (equals != text.npos) entry.material = text.substr(0, equals);
    if (equals == 0) throw_usage("--material {}: expected a name before the '='", text);
    const std::string spec = equals == text.npos ? text : text.substr(equals + 1);
    if (spec == kMatte) return entry;
    try {
        entry.brdf = parse_brdf(spec)->text();
    } catch (const Error& error) {
        throw_usage("--material {}: {} (or expected '{}')", text, error.what(), kMatte);
    }
    return entry;
}

std::vector<GlossMaterial> gloss_of_libraries(const std::string& name,
                                              const ObjLibraries& libraries,
                                              std::vector<std::string>& warnings) {
    std::vector<GlossMaterial> gloss;
    size_t num_clamped = 0, num_alone = 0;
    for (const ObjMaterial& material : libraries.materials) {
        Clamp clamp;
        gloss.push_back(gloss_of(material, clamp));
        if (clamp.num_clamped() > 0) ++num_clamped;
        if (material.metallic && !material.roughness) ++num_alone;
    }
    if (num_clamped > 0) {
        warnings.push_back(fmt::format(
            "{}: gloss of {} materials clamped: Ks and Pm to 0..1, Ns to {:g}..{:g}, Pr to {:g}..{:g}",
            name, num_clamped, kLeastExponent, kMostExponent, kLeastRoughness, kMostRoughness));
    }
    if (num_alone > 0) {
        warnings.push_back(
            fmt::format("{}: Pm of {} materials ignored, as they have no Pr", name, num_alone));
    }
    return gloss;
}

void set_diffuse_shares(const GlossChoice& choice, const ObjScan& scan,
                        std::span<const GlossMaterial> of_library, ObjLibraries& libraries) {
    if (of_library.empty()) return;
    const Chooser chooser(choice, scan, libraries, of_library);
    for (size_t named = 0; named < libraries.of_name.size(); ++named) {
        const int32_t index = libraries.of_name[named];
        if (index < 0 || chooser.override_of(static_cast<int32_t>(named)) != nullptr) continue;
        ObjMaterial& material = libraries.materials[static_cast<size_t>(index)];
        material.diffuse_share = diffuse_share(material, of_library[static_cast<size_t>(index)]);
    }
}

GlossyMaterials count_glossy(const ObjScan& scan, const ObjLibraries& libraries) {
    std::vector<uint8_t> is_used(scan.materials.size(), 0);
    for (const int32_t named : scan.face_materials) {
        if (named >= 0) is_used[static_cast<size_t>(named)] = 1;
    }
    GlossyMaterials glossy;
    Clamp clamp;
    for (size_t i = 0; i < is_used.size(); ++i) {
        const ObjMaterial* const material = material_of_name(libraries, static_cast<int32_t>(i));
        if (is_used[i] == 0 || material == nullptr || gloss_of(*material, clamp).brdf.empty()) {
            continue;
        }
        if (glossy.number++ == 0) glossy.first = printable(material->name);
    }
    return glossy;
}

FoundGloss find_gloss(const std::string& name, const GlossChoice& choice, const ObjScan& scan,
                      const ObjLibraries& libraries, std::span<const GlossMaterial> of_library,
                      const Topology& topology, std::span<const uint32_t> polygons,
                      std::span<const Vec3f> positions) {
    const Chooser chooser(choice, scan, libraries, of_library);
    check_names(name, choice, scan, chooser);
    PAIM_CHECK_EQ(polygons.size(), topology.triangles.size());
    FoundGloss found;
    Materials& materials = found.materials;
    const auto number_of = [&](int32_t named) {
        const auto [known, is_new] = found.of_name.try_emplace(named, uint16_t{0});
        if (!is_new) return known->second;
        const GlossMaterial gloss = chooser.gloss(named);
        if (gloss.brdf.empty()) return known->second;
        const auto same = std::find(materials.glossy.begin(), materials.glossy.end(), gloss);
        const auto index = static_cast<size_t>(same - materials.glossy.begin());
        if (same == materials.glossy.end()) materials.glossy.push_back(gloss);
        if (index >= 65535) {
            throw_unsupported("{}: more than 65535 different glossy materials", name);
        }
        return known->second = static_cast<uint16_t>(index + 1);
    };
    std::vector<uint16_t> of_face;
    of_face.reserve(polygons.size());
    for (const uint32_t polygon : polygons) {
        of_face.push_back(
            number_of(scan.face_materials.empty() ? -1 : scan.face_materials[polygon]));
    }
    if (!materials.empty()) {
        materials.of_vertex = materials_of_vertices(topology, positions, of_face);
    }
    return found;
}

}  // namespace paim
