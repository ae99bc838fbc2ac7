// Integrals over the directions that a BRDF reflects light to.
// Based on: Davis and Rabinowitz 1984 (see the header)
#include "compressor/material/lobe_quadrature.h"

#include <algorithm>
#include <cmath>

namespace paim {

namespace {

constexpr int kRadialNodes = 8, kAroundNodes = 6;
// Panels get no narrower than this share of what they are at normal incidence.
constexpr double kNarrowest = 1e-3;
// The length of panels that end where nothing is known to change fast.
constexpr double kMiddle = 0.5;
// Points whose share of the integral is below this are left out.
constexpr double kNegligible = 1e-9;

struct Panel {
    double begin, length;
};

// Panels of [begin, end] that double in length from both ends, where they are about as long as first
// and last.
void add_panels(double begin, double end, double first, double last, std::vector<Panel>& panels) {
    double left = begin, right = end;
    while (right - left > first + last) {
        if (first <= last) {
            panels.push_back({left, first});
            left += first;
            first *= 2.0;
        } else {
            panels.push_back({right - last, last});
            right -= last;
            last *= 2.0;
        }
    }
    const double middle = left + (right - left) * first / (first + last);
    panels.push_back({left, middle - left});
    panels.push_back({middle, right - middle});
}

}  // namespace

LobeQuadrature::LobeQuadrature(const Brdf& brdf)
    : brdf_(brdf),
      width_(brdf.half_width_rad()),
      radial_(gauss_legendre(kRadialNodes, 0.0, 1.0)),
      around_(gauss_legendre(kAroundNodes, 0.0, 1.0)) {}

void LobeQuadrature::points(double cosine, std::vector<Point>& out) const {
    out.clear();
    const double sine = std::sqrt(std::max(0.0, 1.0 - cosine * cosine));
    const Vec3d in(sine, 0.0, cosine), middle(-sine, 0.0, cosine), up(cosine, 0.0, sine);
    const double grazing = std::max(cosine, kNarrowest);
    const double angle_step = std::min(0.5 * grazing, 0.4);
    std::vector<Panel> around, radial;
    add_panels(0.0, 0.5 * kPi, angle_step, angle_step, around);
    add_panels(0.5 * kPi, kPi, angle_step, angle_step, around);
    double largest = 0.0;
    for (const Panel& sector : around) {
        for (const auto& [share, sector_weight] : around_) {
            const double angle = sector.begin + share * sector.length;
            const Vec3d outwards = std::cos(angle) * up + std::sin(angle) * Vec3d::UnitY();
            const double horizon = std::atan2(cosine, -std::cos(angle) * sine);
            radial.clear();
            const double first = std::min(width_ * grazing, 0.5 * horizon);
            const double last = std::min(0.4 * grazing, 0.5 * horizon);
            if (horizon <= 0.5 * kPi) {
                add_panels(0.0, horizon, first, last, radial);
            } else {
                // Lobes about the mirror direction may end at a right angle to it.
                add_panels(0.0, 0.5 * kPi, first, kMiddle, radial);
                add_panels(0.5 * kPi, horizon, kMiddle, last, radial);
            }
            for (const Panel& panel : radial) {
                for (const auto& [at, weight] : radial_) {
                    const double radius = panel.begin + at * panel.length;
                    const Vec3d v = std::cos(radius) * middle + std::sin(radius) * outwards;
                    const double solid_angle = 2.0 * std::sin(radius) * weight * panel.length *
                                               sector_weight * sector.length;
                    const double value = brdf_.value(in, v);
                    largest = std::max(largest, value * solid_angle);
                    if (value * solid_angle <= kNegligible * largest) continue;
                    out.push_back({v, value, solid_angle});
                }
            }
        }
    }
}

}  // namespace paim
