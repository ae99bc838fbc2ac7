// What a file has to meet: what follows from what, and how far measured errors are from it.
#include "compressor/encode/search/targets.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace paim {
namespace {

// One vertex that is off by a distance, with these errors of the shape in the worst piece.
SurfaceError surface_error(double distance, double sted, double angle_deg) {
    SurfaceError error;
    error.geometry.distance.squared_sum = distance * distance;
    error.geometry.distance.num_vertices = 1;
    error.geometry.diagonal = 10.0;
    error.shape.worst.sted_space = sted;
    error.shape.worst.normal_angle_deg = angle_deg;
    return error;
}

TEST(Targets, FollowFromTheErrorOfTheTransfer) {
    const Targets targets = targets_of(EncodeTarget(), 0.05, 20.0);
    EXPECT_EQ(targets.transfer, 0.05);
    EXPECT_DOUBLE_EQ(targets.surface.distance, 0.001 * 20.0);
    EXPECT_DOUBLE_EQ(targets.surface.sted, kStedPerGeometryError * 0.001);
    EXPECT_DOUBLE_EQ(targets.surface.normal_angle_deg, kNormalDegreesPerGeometryError * 0.001);
}

TEST(Targets, OfTheShapeFollowFromTheGeometryErrorThatIsAskedFor) {
    EncodeTarget asked;
    asked.geometry_error = 1e-4;
    Targets targets = targets_of(asked, 0.05, 1.0);
    EXPECT_DOUBLE_EQ(targets.surface.distance, 1e-4);
    EXPECT_DOUBLE_EQ(targets.surface.sted, kStedPerGeometryError * 1e-4);
    asked.sted = 0.3;
    asked.normal_angle_deg = 7.0;
    targets = targets_of(asked, 0.05, 1.0);
    EXPECT_EQ(targets.surface.distance, 1e-4);
    EXPECT_EQ(targets.surface.sted, 0.3);
    EXPECT_EQ(targets.surface.normal_angle_deg, 7.0);
}

TEST(Targets, OfTheShapeAreAtMostThoseOfAnyShape) {
    EncodeTarget asked;
    asked.geometry_error = 0.1;
    const Targets targets = targets_of(asked, 0.05, 1.0);
    EXPECT_EQ(targets.surface.sted, kLargestSted);
    EXPECT_EQ(targets.surface.normal_angle_deg, kLargestNormalAngle_deg);
}

TEST(Excess, IsTheLargestOfThreeShares) {
    const SurfaceTarget target{2.0, 0.1, 4.0};
    EXPECT_DOUBLE_EQ(excess(surface_error(1.0, 0.01, 1.0), target), 0.5);
    EXPECT_DOUBLE_EQ(excess(surface_error(1.0, 0.07, 1.0), target), 0.7);
    EXPECT_DOUBLE_EQ(excess(surface_error(1.0, 0.07, 6.0), target), 1.5);
}

TEST(Excess, OfBadNumbersIsNeverGood) {
    const SurfaceTarget target{2.0, 0.1, 4.0};
    const double nan = std::numeric_limits<double>::quiet_NaN();
    EXPECT_TRUE(std::isnan(excess(surface_error(nan, 0.0, 0.0), target)));
    EXPECT_TRUE(std::isnan(excess(surface_error(9.0, 9.0, nan), target)));
    EXPECT_TRUE(std::isnan(excess(SurfaceError(), target))) << "nothing was measured";
    // No error meets a target of nothing, and no other does.
    EXPECT_EQ(excess(surface_error(0.0, 0.0, 0.0), {}), 0.0);
    EXPECT_TRUE(std::isinf(excess(surface_error(0.0, 1e-9, 0.0), {})));
}

TEST(MissedSurface, NamesTheWorstErrorAndItsOption) {
    const SurfaceTarget target{2.0, 0.1, 4.0};
    EXPECT_EQ(missed_surface(surface_error(4.0, 0.11, 4.1), target),
              "an RMS distance of 2 is asked for, but positions as floats have 4 at best: allow a "
              "--geometry-error of 0.42 or more");
    EXPECT_EQ(missed_surface(surface_error(1.0, 0.2, 4.1), target),
              "a STED of 10 % is asked for, but positions as floats have 20 % at best in the worst "
              "piece of the mesh: allow a --max-sted of 21% or more");
    EXPECT_EQ(
        missed_surface(surface_error(1.0, 0.2, 10.0), target),
        "a mean angle of face normals of 4 degrees is asked for, but positions as floats have "
        "10 at best in the worst piece of the mesh: allow a --max-normal-angle of 10.5 or "
        "more");
}

}  // namespace
}  // namespace paim
