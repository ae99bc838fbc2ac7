// Materials that reflect more light than arrives.
#include "compressor/io/obj_reflectance.h"

#include <fmt/format.h>

#include <map>

#include "compressor/io/obj_text.h"
#include "compressor/material/brdfs.h"
#include "compressor/material/reflectance.h"

namespace paim {

namespace {

// Rounding of numbers in words (6 digits), and of the integral (1e-6).
constexpr double kReflectanceRounding = 1e-4;
constexpr size_t kMaxBright = 8;

Vec3d brightest_corner(std::span<const uint32_t> corners, const Albedo& albedo) {
    Vec3d colour = Vec3d::Zero();
    for (const uint32_t v : corners) colour = colour.cwiseMax(albedo.at(v).cast<double>());
    return colour;
}

// The largest diffuse colour of the faces of each name of the scan, or -1, that is glossy.
std::map<int32_t, Vec3d> brightest_colours(const ObjScan& scan, const FoundGloss& gloss,
                                           std::span<const Vec3d> colours, const Albedo& albedo) {
    std::map<int32_t, Vec3d> brightest;
    std::span<const uint32_t> rest = scan.faces.corners;
    for (size_t face = 0; face < scan.faces.num_faces(); ++face) {
        const std::span<const uint32_t> corners = rest.first(scan.faces.sizes[face]);
        rest = rest.subspan(corners.size());
        const int32_t named = scan.face_materials.empty() ? -1 : scan.face_materials[face];
        const auto known = gloss.of_name.find(named);
        if (known == gloss.of_name.end() || known->second == 0) continue;
        Vec3d& colour = brightest.try_emplace(named, Vec3d::Zero()).first->second;
        colour =
            colour.cwiseMax(colours.empty() ? brightest_corner(corners, albedo) : colours[face]);
    }
    return brightest;
}

std::string subject(const ObjScan& scan, const ObjLibraries& libraries, int32_t named) {
    if (named < 0) return "faces without a material reflect";
    const ObjMaterial* const material = material_of_name(libraries, named);
    const std::string& name =
        material != nullptr ? material->name : scan.materials[static_cast<size_t>(named)];
    return fmt::format("the material '{}' reflects", printable(name));
}

}  // namespace

std::vector<std::string> reflectance_warnings(const std::string& name, const ObjScan& scan,
                                              const ObjLibraries& libraries,
                                              const FoundGloss& gloss,
                                              std::span<const Vec3d> colours,
                                              const Albedo& albedo) {
    constexpr const char* kChannels[] = {"red", "green", "blue"};
    std::map<std::string, double> of_brdf;
    std::vector<std::string> warnings;
    size_t num_more = 0;
    for (const auto& [named, diffuse] : brightest_colours(scan, gloss, colours, albedo)) {
        const GlossMaterial& material = gloss.materials.glossy[gloss.of_name.at(named) - 1u];
        const auto [known, is_new] = of_brdf.try_emplace(material.brdf, 0.0);
        if (is_new) known->second = normal_reflectance(*parse_brdf(material.brdf));
        const Vec3d glossy = known->second * material.tint.cast<double>();
        int channel = 0;
        const double sum = (diffuse + glossy).maxCoeff(&channel);
        if (sum <= 1.0 + kReflectanceRounding) continue;
        if (warnings.size() == kMaxBright) {
            ++num_more;
            continue;
        }
        warnings.push_back(fmt::format(
            "{}: {} more light than arrives: expected at most 1 of {}, got {:.3g} ({:.3g} diffuse "
            "and {:.3g} glossy). With --bounces the light grows at every bounce",
            name, subject(scan, libraries, named), kChannels[channel], sum, diffuse[channel],
            glossy[channel]));
    }
    if (num_more > 0) {
        warnings.push_back(
            fmt::format("{}: {} more materials reflect more light than arrives", name, num_more));
    }
    return warnings;
}

}  // namespace paim
