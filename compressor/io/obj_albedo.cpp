// The albedo of a mesh.
#include "compressor/io/obj_albedo.h"

#include <fmt/format.h>

#include <algorithm>

#include "compressor/io/vertex_colours.h"
#include "paim/base/check.h"

namespace paim {

namespace {

// Clamps to [0, 1] and counts the colours that it changed.
Vec3d clamp_color(const Vec3d& color, size_t& num_clamped) {
    // Written so that NaN becomes 0.
    const Vec3d clamped =
        color.unaryExpr([](double x) { return x > 0.0 ? std::min(x, 1.0) : 0.0; });
    if (clamped != color) ++num_clamped;
    return clamped;
}

// [materials + 1] colours to average; the last is for faces without a material.
std::vector<Vec3d> material_colors(const std::string& name,
                                   const std::vector<ObjMaterial>& materials,
                                   std::vector<std::string>& warnings) {
    const Vec3d none = Albedo().values[0].cast<double>();
    std::vector<Vec3d> colors;
    size_t num_clamped = 0;
    for (const ObjMaterial& material : materials) {
        colors.push_back(clamp_color(material.diffuse.value_or(none), num_clamped) *
                         material.diffuse_share);
    }
    colors.push_back(none);
    if (num_clamped > 0) {
        warnings.push_back(
            fmt::format("{}: Kd of {} materials clamped to 0..1", name, num_clamped));
    }
    return colors;
}

}  // namespace

Albedo albedo_of_colours(const std::string& name, const std::vector<Vec3d>& colours, bool srgb,
                         std::vector<std::string>& warnings) {
    Albedo albedo{{}};
    size_t num_clamped = 0;
    for (const Vec3d& color : colours) {
        const Vec3d clamped = clamp_color(color, num_clamped);
        albedo.values.push_back((srgb ? linear_from_srgb(clamped) : clamped).cast<float>());
    }
    if (num_clamped > 0) {
        warnings.push_back(fmt::format("{}: {} vertex colours clamped to 0..1", name, num_clamped));
    }
    return albedo;
}

std::vector<Vec3d> colours_of_faces(const std::string& name, const ObjScan& scan,
                                    const ObjLibraries& libraries,
                                    std::vector<std::string>& warnings) {
    if (libraries.materials.empty()) return {};
    PAIM_CHECK_EQ(scan.face_materials.size(), scan.faces.num_faces());
    const std::vector<Vec3d> colors = material_colors(name, libraries.materials, warnings);
    std::vector<Vec3d> of_faces;
    of_faces.reserve(scan.faces.num_faces());
    for (const int32_t named : scan.face_materials) {
        const ObjMaterial* const material = material_of_name(libraries, named);
        const auto index = material != nullptr
                               ? static_cast<size_t>(material - libraries.materials.data())
                               : libraries.materials.size();
        of_faces.push_back(colors[index]);
    }
    return of_faces;
}

Albedo albedo_of_faces(const ObjScan& scan, std::span<const Vec3d> colours) {
    if (colours.empty()) return {};
    const Polygons& faces = scan.faces;
    PAIM_CHECK_EQ(colours.size(), faces.num_faces());
    const bool uniform = std::all_of(colours.begin(), colours.end(),
                                     [&](const Vec3d& colour) { return colour == colours[0]; });
    if (uniform) return {{colours[0].cast<float>()}};

    std::vector<Vec3d> sums(scan.num_vertices, Vec3d::Zero());
    std::vector<uint32_t> counts(scan.num_vertices, 0);
    size_t corner = 0;
    for (size_t i = 0; i < faces.num_faces(); ++i) {
        for (const size_t end = corner + faces.sizes[i]; corner < end; ++corner) {
            sums[faces.corners[corner]] += colours[i];
            ++counts[faces.corners[corner]];
        }
    }
    const Vec3d none = Albedo().values[0].cast<double>();
    Albedo albedo{{}};
    for (size_t v = 0; v < sums.size(); ++v) {
        const Vec3d mean = counts[v] > 0 ? Vec3d(sums[v] / counts[v]) : none;
        albedo.values.push_back(mean.cast<float>());
    }
    return albedo;
}

}  // namespace paim
