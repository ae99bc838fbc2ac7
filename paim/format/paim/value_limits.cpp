// What the numbers of a .paim must keep to so that every pose decodes to finite values.
#include "paim/format/paim/value_limits.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "paim/base/error.h"
#include "paim/codec/magnitude_bounds.h"
#include "paim/codec/surface_smoothing.h"

namespace paim {

std::vector<float> read_steps(const ContainerReader& reader, const Section& section) {
    std::vector<float> steps = reader.read_f32(section);
    for (const float step : steps) {
        if (!(step >= 0.0f && step <= kMaxStep)) {
            throw_bad_input("{}: steps: expected numbers from 0 to {:.3g}, got {}",
                            reader.label(section), kMaxStep, step);
        }
    }
    return steps;
}

void check_singular_values(const ContainerReader& reader, const LowRank& matrix) {
    double previous = std::numeric_limits<double>::infinity();
    for (const double s : matrix.singular_values) {
        if (!(s >= 0.0 && s <= previous && std::isfinite(s))) {
            throw_bad_input("{}: singular values: expected finite, descending numbers, got {}",
                            reader.name(), s);
        }
        previous = s;
    }
    if (matrix.singular_values.size() < matrix.num_components) {
        throw_bad_input("{}: {} singular values, expected at least the {} components'",
                        reader.name(), matrix.singular_values.size(), matrix.num_components);
    }
}

void check_smoothing(const ContainerReader& reader, const LowRank& positions) {
    if (positions.fraction_bits == 0) return;
    if (positions.holds_floats()) {
        throw_bad_input(
            "{}: positions are floats, expected integers, as they have {} fraction bits",
            reader.name(), positions.fraction_bits);
    }
    const uint32_t most = smoothing_fraction_bits(positions);
    if (positions.fraction_bits > most) {
        throw_bad_input(
            "{}: positions of {} fraction bits, expected at most {} with integers so large",
            reader.name(), positions.fraction_bits, most);
    }
}

MagnitudeLimits::MagnitudeLimits(const CodedMesh& mesh) {
    double farthest = 0.0;
    for (const RigidTransform& root : mesh.root_motion) {
        farthest = std::max(farthest, root.translation.cwiseAbs().maxCoeff());
    }
    // A rotation of three coordinates makes one of them at most √3 times as large.
    const double turned = mesh.root_motion.empty() ? 1.0 : std::sqrt(3.0);
    growth_[static_cast<size_t>(Attribute::geometry)] = {turned, farthest};
    growth_[static_cast<size_t>(Attribute::transfer)] = {mesh.transfer->vertex_gain(), 0.0};
    growth_[static_cast<size_t>(Attribute::gloss)] = {
        mesh.gloss ? mesh.gloss->transfer->vertex_gain() : 1.0, 0.0};
}

void MagnitudeLimits::check(Attribute attribute, std::span<const double> bounds,
                            std::string_view where, std::string_view advice) const {
    constexpr std::array<const char*, kNumAttributes> kWords{"positions", "transfer", "gloss"};
    constexpr double kMax = std::numeric_limits<float>::max();
    const Growth& growth = growth_[static_cast<size_t>(attribute)];
    for (const double bound : bounds) {
        const double most = bound * growth.factor + growth.added;
        if (bound <= kMax && most <= kMax) continue;
        throw_bad_input(
            "{}{}: means, components and weights decode to numbers of up to {:.3g}, expected at "
            "most {:.3g}{}",
            where, kWords[static_cast<size_t>(attribute)], most, kMax, advice);
    }
}

void check_magnitudes(const CodedMesh& mesh, std::string_view where, std::string_view advice) {
    const MagnitudeLimits limits(mesh);
    for (const Attribute attribute : mesh.attributes()) {
        limits.check(attribute, magnitude_bounds(mesh.attribute(attribute)), where, advice);
    }
}

}  // namespace paim
