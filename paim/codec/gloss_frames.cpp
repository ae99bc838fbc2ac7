// The frames of glossy vertices.
#include "paim/codec/gloss_frames.h"

#include <algorithm>
#include <cmath>

#include "paim/mesh/face_vertices.h"
#include "paim/mesh/planes.h"
#include "paim/mesh/root_motion.h"

namespace paim {

namespace {

// A turn of π is the largest integer of 16 bits.
constexpr double kTurnStep_rad = kPi / 32767.0;

std::vector<Eigen::Matrix3f> rotations(std::span<const Vec3f> vectors) {
    std::vector<Eigen::Matrix3f> matrices;
    for (const Vec3f& vector : vectors) {
        matrices.push_back(rotation_of(vector.cast<double>()).toRotationMatrix().cast<float>());
    }
    return matrices;
}

}  // namespace

Topology faces_of_gloss(const Topology& whole, std::span<const uint32_t> rows) {
    return rows.empty() ? whole : faces_among(whole, rows);
}

LowRank frame_turns(std::span<const Vec3f> vectors) {
    std::vector<int16_t> integers;
    for (int axis = 0; axis < 3; ++axis) {
        for (const Vec3f& vector : vectors) {
            const double steps = std::nearbyint(static_cast<double>(vector[axis]) / kTurnStep_rad);
            integers.push_back(static_cast<int16_t>(std::clamp(steps, -32767.0, 32767.0)));
        }
    }
    // Normals that are computed in other orders differ in their last bits.
    if (std::all_of(integers.begin(), integers.end(), [](int i) { return std::abs(i) <= 1; })) {
        return {};
    }
    const auto step = static_cast<float>(kTurnStep_rad);
    return LowRank::still(3, std::move(integers), {step, step, step});
}

std::vector<Vec3f> turn_vectors(const LowRank& turns) {
    return from_planes(turns.mean_floats());
}

GlossFrames::GlossFrames(const Topology& faces, std::span<const float> reference,
                         std::span<const Vec3f> turns)
    : frames_(faces, from_planes(reference)), turns_(rotations(turns)) {}

std::vector<Eigen::Matrix3f> GlossFrames::at(std::span<const float> positions) const {
    std::vector<Eigen::Matrix3f> frames = frames_.at(from_planes(positions));
    for (size_t r = 0; r < turns_.size(); ++r) frames[r] = frames[r] * turns_[r];
    return frames;
}

}  // namespace paim
