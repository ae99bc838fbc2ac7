// Cube maps and angular maps as lat-long maps.
// Based on: OpenEXR, ImfEnvmap.h; Debevec 1998 (see the header)
#include "paim/light/to_latlong.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "paim/base/parallel.h"
#include "paim/light/environment.h"

namespace paim {

namespace {

constexpr int kSamples = 4;  // a pixel, along each side
constexpr int kMinHeight = 512;
constexpr int kMaxHeight = 2048;

// A place in an image, in pixels from its upper left corner.
struct Place {
    double x, y;
};

// Interpolates between the centres of pixels [0, size) × [first_row, first_row + size). Pixels for
// which `has` is false have no weight.
template <typename Has>
Vec3d interpolate(const Image& image, const Place& place, int size, int first_row, const Has& has) {
    const double x = std::clamp(place.x - 0.5, 0.0, size - 1.0);
    const double y = std::clamp(place.y - 0.5, 0.0, size - 1.0);
    const int x0 = static_cast<int>(x);
    const int y0 = static_cast<int>(y);
    Vec3d sum = Vec3d::Zero();
    double weights = 0.0;
    for (int j = 0; j < 2; ++j) {
        const int py = std::min(y0 + j, size - 1);
        const double wy = j == 0 ? 1.0 - (y - y0) : y - y0;
        for (int i = 0; i < 2; ++i) {
            const int px = std::min(x0 + i, size - 1);
            if (!has(px, py)) continue;
            const double weight = wy * (i == 0 ? 1.0 - (x - x0) : x - x0);
            sum += weight * image.at(px, first_row + py).cast<double>();
            weights += weight;
        }
    }
    return weights > 0.0 ? Vec3d(sum / weights) : Vec3d::Zero();
}

// Sines and cosines of longitude (latitude) at the samples of columns (rows), as
// direction_from_latlong() has them.
std::vector<Eigen::Vector2d> sines_and_cosines(int count, double first, double step) {
    std::vector<Eigen::Vector2d> result;
    for (int i = 0; i < count * kSamples; ++i) {
        const double angle = first + step * (i + 0.5) / (count * kSamples);
        result.emplace_back(std::sin(angle), std::cos(angle));
    }
    return result;
}

// A lat-long map of what `look(direction)` sees.
template <typename Look>
Image gather(int height, const Look& look) {
    height = std::clamp(height, kMinHeight, kMaxHeight);
    Image map(2 * height, height);
    const auto longitudes = sines_and_cosines(map.width, kPi, -2.0 * kPi);
    const auto latitudes = sines_and_cosines(map.height, 0.5 * kPi, -kPi);
    parallel_for(static_cast<size_t>(height), 1, [&](size_t row, size_t) {
        const auto* const latitude = latitudes.data() + row * kSamples;
        const Vec3d nothing = Vec3d::Zero();
        for (int x = 0; x < map.width; ++x) {
            const auto* const longitude = longitudes.data() + static_cast<size_t>(x) * kSamples;
            Vec3d sum = nothing;
            double weights = 0.0;
            for (int j = 0; j < kSamples; ++j) {
                const double cosine = latitude[j].y();  // ∝ solid angle
                Vec3d line = nothing;
                for (int i = 0; i < kSamples; ++i) {
                    line += look(Vec3d(longitude[i].x() * cosine, latitude[j].x(),
                                       longitude[i].y() * cosine));
                }
                sum += cosine * line;
                weights += kSamples * cosine;
            }
            map.at(x, static_cast<int>(row)) = (sum / weights).cast<float>();
        }
    });
    return map;
}

// Face and place of the direction. `right` and `down` are those of the face as it lies in the
// image, seen from inside the cube.
struct CubePlace {
    int face;
    double right, down;  // −1 … 1
};

CubePlace find_in_cube(const Vec3d& d) {
    const Vec3d size = d.cwiseAbs();
    if (size.x() >= size.y() && size.x() >= size.z()) {
        const double right = d.x() > 0.0 ? d.z() : -d.z();
        return {d.x() > 0.0 ? 0 : 1, right / size.x(), -d.y() / size.x()};
    }
    if (size.y() >= size.z()) {
        const double down = d.y() > 0.0 ? -d.z() : d.z();
        return {d.y() > 0.0 ? 2 : 3, d.x() / size.y(), down / size.y()};
    }
    const double right = d.z() > 0.0 ? -d.x() : d.x();
    return {d.z() > 0.0 ? 4 : 5, right / size.z(), -d.y() / size.z()};
}

}  // namespace

Image latlong_from_cube(const Image& cube) {
    PAIM_CHECK_LE(1, cube.width);
    PAIM_CHECK_EQ(cube.height, 6 * cube.width);
    const int n = cube.width;
    return gather(2 * n, [&](const Vec3d& direction) {
        const CubePlace place = find_in_cube(direction);
        return interpolate(cube, {0.5 * n * (place.right + 1.0), 0.5 * n * (place.down + 1.0)}, n,
                           place.face * n, [](int, int) { return true; });
    });
}

bool is_in_circle(int x, int y, int size) {
    const double dx = x + 0.5 - 0.5 * size;
    const double dy = y + 0.5 - 0.5 * size;
    return dx * dx + dy * dy <= 0.25 * size * size;
}

Image latlong_from_angular(const Image& probe) {
    PAIM_CHECK_LE(1, probe.width);
    PAIM_CHECK_EQ(probe.height, probe.width);
    const int n = probe.width;
    return gather(n / 2, [&](const Vec3d& d) {
        const double across = std::hypot(d.x(), d.y());
        const double radius = std::atan2(across, -d.z()) / kPi;  // 0 … 1
        const double scale = across > 0.0 ? radius / across : 0.0;
        return interpolate(probe,
                           {0.5 * n * (1.0 + scale * d.x()), 0.5 * n * (1.0 - scale * d.y())}, n, 0,
                           [n](int x, int y) { return is_in_circle(x, y, n); });
    });
}

}  // namespace paim
