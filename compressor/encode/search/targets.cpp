// What a file has to meet: the error of the transfer, and three errors of the surface.
#include "compressor/encode/search/targets.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace paim {

namespace {

double ratio(double error, double target) {
    if (error == 0.0) return 0.0;
    return target > 0.0 ? error / target : std::numeric_limits<double>::infinity();
}

// Of distance, STED and normal angle.
std::array<double, 3> ratios(const SurfaceError& measured, const SurfaceTarget& target) {
    return {ratio(measured.geometry.rms(), target.distance),
            ratio(measured.shape.worst.sted(), target.sted),
            ratio(measured.shape.worst.normal_angle_deg, target.normal_angle_deg)};
}

std::string missed_distance(const GeometryError& best, double target) {
    const double allowed = 1.05 * best.relative_rms();
    const std::string missed = fmt::format(
        "an RMS distance of {:.3g} is asked for, but positions as floats have {:.3g} at best",
        target, best.rms());
    if (allowed < 1.0) {
        return missed + fmt::format(": allow a --geometry-error of {:.3g} or more", allowed);
    }
    // Poses that are points, or much farther apart than they are large.
    return missed + fmt::format(
                        ", and the diagonal of the largest pose is {:.3g}: bring the poses nearer "
                        "together, or encode without --max-error and --max-size",
                        best.diagonal);
}

}  // namespace

Targets targets_of(const EncodeTarget& target, double transfer_error, double diagonal) {
    const double relative =
        target.geometry_error.value_or(kGeometryPerTransferError * transfer_error);
    const double sted = std::min(kLargestSted, kStedPerGeometryError * relative);
    const double angle_deg =
        std::min(kLargestNormalAngle_deg, kNormalDegreesPerGeometryError * relative);
    return {transfer_error,
            target.vertex_error.value_or(std::numeric_limits<double>::infinity()),
            {relative * diagonal, target.sted.value_or(sted),
             target.normal_angle_deg.value_or(angle_deg)}};
}

double excess(const SurfaceError& measured, const SurfaceTarget& target) {
    double largest = 0.0;
    for (const double one : ratios(measured, target)) {
        if (std::isnan(one)) return one;
        largest = std::max(largest, one);
    }
    return largest;
}

std::string missed_surface(const SurfaceError& best, const SurfaceTarget& target) {
    const auto [distance, sted, angle] = ratios(best, target);
    if (!(std::max(sted, angle) > std::max(1.0, distance))) {
        return missed_distance(best.geometry, target.distance);
    }
    constexpr double kABitMore = 1.05;
    if (sted > angle) {
        const double least = best.shape.worst.sted();
        return fmt::format(
            "a STED of {:.3g} % is asked for, but positions as floats have {:.3g} % at best in the "
            "worst piece of the mesh: allow a --max-sted of {:.3g}% or more",
            100.0 * target.sted, 100.0 * least, 100.0 * kABitMore * least);
    }
    const double least = best.shape.worst.normal_angle_deg;
    return fmt::format(
        "a mean angle of face normals of {:.3g} degrees is asked for, but positions as floats have "
        "{:.3g} at best in the worst piece of the mesh: allow a --max-normal-angle of {:.3g} or "
        "more",
        target.normal_angle_deg, least, kABitMore * least);
}

}  // namespace paim
