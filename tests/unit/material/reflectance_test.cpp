// How much of the light that arrives a BRDF reflects.
#include "compressor/material/reflectance.h"

#include <gtest/gtest.h>

#include "compressor/material/brdfs.h"
#include "tests/unit/material/lambertian.h"

namespace paim {
namespace {

// Closed forms: π · (albedo / π), and Phong's ks, by which it is normalised. Tolerances are the error
// of the quadrature.
TEST(Reflectance, IsTheShareAtNormalIncidence) {
    EXPECT_NEAR(normal_reflectance(Lambertian(0.3)), 0.3, 1e-6 * 0.3);
    for (const char* phong : {"phong:0.5,1", "phong:0.5,20", "phong:0.5,3000"}) {
        EXPECT_NEAR(normal_reflectance(*parse_brdf(phong)), 0.5, 1e-6 * 0.5) << phong;
    }
    EXPECT_EQ(normal_reflectance(*parse_brdf("phong:0,20")), 0.0);
}

// A smooth surface reflects F0 at normal incidence; a rough one loses some of it to its own shadow, as
// light is followed to one facet alone.
TEST(Reflectance, OfASmoothSurfaceIsF0) {
    const double smooth = normal_reflectance(*parse_brdf("cook-torrance:0.5,0.02"));
    const double rough = normal_reflectance(*parse_brdf("cook-torrance:0.5,1"));
    EXPECT_NEAR(smooth, 0.5, 1e-6);  // observed: 8e-8 off
    EXPECT_LT(rough, smooth);
    EXPECT_GT(rough, 0.0);
}

}  // namespace
}  // namespace paim
