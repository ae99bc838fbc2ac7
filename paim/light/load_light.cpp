// Environment maps as they come.
#include "paim/light/load_light.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "paim/base/error.h"
#include "paim/image/area_average.h"
#include "paim/light/radiance_check.h"
#include "paim/light/to_latlong.h"

namespace paim {

namespace {

// Larger cube maps and angular maps are averaged down to these before they are converted.
constexpr int kMaxFace = 1024;
constexpr int kMaxProbe = 2048;

// Light probes are black outside of the circle, but for what lossy compression leaves there.
bool is_black_outside_circle(const std::filesystem::path& path, const ExrHeader& header,
                             const ExrLimits& limits) {
    constexpr float kBlack = 1e-3f;  // of the brightest value within
    // A pixel on the circle may be either.
    const auto is_outside = [size = header.width](int x, int y) {
        const auto corner = [size](int i) { return i < size / 2 ? i + 1 : i - 1; };
        return !is_in_circle(corner(x), corner(y), size);
    };
    float inside = 0.0f;
    float outside = 0.0f;
    if (!is_outside(0, 0)) return false;  // too small to tell
    read_exr_rows(
        path,
        [&](int x, int y, std::span<const Vec3f> pixels) {
            for (const Vec3f& pixel : pixels) {
                float& brightest = is_outside(x++, y) ? outside : inside;
                brightest = std::max(brightest, pixel.cwiseAbs().maxCoeff());
            }
        },
        limits);
    return inside > 0.0f && outside <= kBlack * inside;
}

// What is read of the file, at most as large as what is kept.
AreaAverage make_average(const ExrHeader& header, EnvMapping mapping) {
    const int width = header.width;
    const int height = header.height;
    if (mapping == EnvMapping::cube) {
        const int face = std::min(width, kMaxFace);
        return {width, height, face, 6 * face, RowArea::equal};
    }
    if (mapping == EnvMapping::angular) {
        const int size = std::min(width, kMaxProbe);
        return {width, height, size, size, RowArea::equal};
    }
    return {width, height, std::min(width, kMaxMapWidth), std::min(height, kMaxMapHeight),
            RowArea::latlong};
}

// Checks, converts and averages the pixels. The check sees the file's own values: colours that
// Rec. 709 does not have get values below zero.
Image read_checked_pixels(const std::filesystem::path& path, const ExrHeader& header,
                          EnvMapping mapping, const std::optional<Eigen::Matrix3d>& rec709,
                          const ExrLimits& limits) {
    AreaAverage average = make_average(header, mapping);
    RadianceCheck check;
    std::vector<Vec3f> run;
    read_exr_rows(
        path,
        [&](int x, int y, std::span<const Vec3f> pixels) {
            run.assign(pixels.begin(), pixels.end());
            if (mapping == EnvMapping::angular) {
                // Nothing is out there, whatever the file has.
                for (size_t i = 0; i < run.size(); ++i) {
                    const int column = x + static_cast<int>(i);
                    if (!is_in_circle(column, y, header.width)) run[i].setZero();
                }
            }
            const bool latlong = mapping == EnvMapping::latlong;
            check.add(x, y, run, latlong ? latlong_row_weight(y, header.height) : 1.0);
            if (rec709) {
                for (Vec3f& pixel : run) pixel = (*rec709 * pixel.cast<double>()).cast<float>();
            }
            average.add(x, y, run);
        },
        limits);
    check.finish();
    return average.take();
}

// The matrix to Rec. 709 if the file's colours need one; a note if they state nothing sensible.
std::optional<Eigen::Matrix3d> find_conversion(const ExrHeader& header,
                                               std::vector<std::string>& notes) {
    if (!header.chromaticities || is_rec709(*header.chromaticities)) return std::nullopt;
    std::optional<Eigen::Matrix3d> matrix = rec709_from(*header.chromaticities);
    if (!matrix) notes.push_back("its chromaticities are no colour space; read as Rec. 709");
    return matrix;
}

void note_parts(const ExrHeader& header, std::vector<std::string>& notes) {
    if (header.num_parts == 1) return;
    notes.push_back(fmt::format("it has {} parts; the first{} is read", header.num_parts,
                                header.part_name.empty() ? "" : ", '" + header.part_name + "',"));
}

LoadedLight load(const std::filesystem::path& path, EnvMapping wanted, const ExrLimits& limits) {
    const ExrHeader header = read_exr_header(path, limits);
    MappingChoice choice = choose_mapping(
        header, wanted, [&] { return is_black_outside_circle(path, header, limits); });
    std::vector<std::string> notes = choice.notes;
    const std::optional<Eigen::Matrix3d> rec709 = find_conversion(header, notes);
    note_parts(header, notes);
    Image image = read_checked_pixels(path, header, choice.mapping, rec709, limits);
    if (choice.mapping == EnvMapping::cube) image = latlong_from_cube(image);
    if (choice.mapping == EnvMapping::angular) image = latlong_from_angular(image);
    EnvironmentLight light = EnvironmentLight::of_checked(std::move(image));
    if (light.is_black()) notes.push_back("it is black");
    return {std::move(light), header, std::move(choice), rec709.has_value(), std::move(notes)};
}

}  // namespace

LoadedLight load_light(const std::filesystem::path& path, EnvMapping mapping,
                       const ExrLimits& limits) {
    try {
        return load(path, mapping, limits);
    } catch (const Error& error) {
        const std::string name = path.string();
        if (std::string_view(error.what()).starts_with(name + ": ")) throw;
        throw Error(error.code(), fmt::format("{}: {}", name, error.what()));
    }
}

}  // namespace paim
