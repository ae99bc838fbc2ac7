// An icosahedron cut finer and finer, and sums of basis functions over its corners.
#include "player/inspect/lobe.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <utility>

#include "paim/base/check.h"
#include "paim/base/parallel.h"
#include "paim/sh/basis.h"
#include "player/inspect/false_color.h"
#include "player/inspect/transfer_channel.h"

namespace paim::player {

namespace {

struct Sphere {
    std::vector<Vec3d> directions;
    std::vector<Triangle> triangles;
};

Sphere icosahedron() {
    const double g = (1.0 + std::sqrt(5.0)) / 2.0;
    Sphere sphere{
        {{-1, g, 0},
         {1, g, 0},
         {-1, -g, 0},
         {1, -g, 0},
         {0, -1, g},
         {0, 1, g},
         {0, -1, -g},
         {0, 1, -g},
         {g, 0, -1},
         {g, 0, 1},
         {-g, 0, -1},
         {-g, 0, 1}},
        {{0, 11, 5},  {0, 5, 1},  {0, 1, 7},  {0, 7, 10}, {0, 10, 11}, {1, 5, 9}, {5, 11, 4},
         {11, 10, 2}, {10, 7, 6}, {7, 1, 8},  {3, 9, 4},  {3, 4, 2},   {3, 2, 6}, {3, 6, 8},
         {3, 8, 9},   {4, 9, 5},  {2, 4, 11}, {6, 2, 10}, {8, 6, 7},   {9, 8, 1}}};
    for (Vec3d& direction : sphere.directions) direction.normalize();
    return sphere;
}

// Cuts each triangle into four at the middles of its edges.
void cut_faces(Sphere& sphere) {
    std::map<std::pair<uint32_t, uint32_t>, uint32_t> middles;
    const auto middle = [&](uint32_t a, uint32_t b) {
        const auto [found, is_new] =
            middles.try_emplace(std::minmax(a, b), static_cast<uint32_t>(sphere.directions.size()));
        if (is_new) {
            sphere.directions.push_back((sphere.directions[a] + sphere.directions[b]).normalized());
        }
        return found->second;
    };
    std::vector<Triangle> finer;
    for (const auto& [a, b, c] : sphere.triangles) {
        const uint32_t ab = middle(a, b), bc = middle(b, c), ca = middle(c, a);
        finer.insert(finer.end(), {{a, ab, ca}, {ab, b, bc}, {ca, bc, c}, {ab, bc, ca}});
    }
    sphere.triangles = std::move(finer);
}

}  // namespace

LobeShape::LobeShape(int bands) : bands_(bands) {
    Sphere sphere = icosahedron();
    for (int cut = 0; cut < 4; ++cut) cut_faces(sphere);
    PAIM_CHECK_EQ(sphere.directions.size(), size_t{kNumVertices});
    triangles_ = std::move(sphere.triangles);
    for (const Vec3d& direction : sphere.directions) directions_.push_back(direction.cast<float>());
    const auto num_coefficients = static_cast<size_t>(sh::num_coefficients(bands));
    basis_.resize(num_coefficients * kNumVertices);
    constexpr size_t kDirectionsAtOnce = 64;
    parallel_for(kNumVertices, kDirectionsAtOnce, [&](size_t first, size_t end) {
        std::vector<float> values(num_coefficients);
        for (size_t n = first; n < end; ++n) {
            sh::evaluate_basis(bands, sphere.directions[n], values);
            for (size_t i = 0; i < values.size(); ++i) basis_[i * kNumVertices + n] = values[i];
        }
    });
}

void LobeShape::of(std::span<const float> coefficients, Lobe& out) const {
    PAIM_CHECK_LE(coefficients.size() * kNumVertices, basis_.size());
    out.values.assign(kNumVertices, 0.0f);
    for (size_t i = 0; i < coefficients.size(); ++i) {
        const float* basis = basis_.data() + i * kNumVertices;
        for (size_t n = 0; n < kNumVertices; ++n) out.values[n] += coefficients[i] * basis[n];
    }
    finish(out);
}

void LobeShape::of_basis(uint32_t i, Lobe& out) const {
    const std::span all(basis_);
    PAIM_CHECK_LT(size_t{i} * kNumVertices, all.size());
    const auto values = all.subspan(size_t{i} * kNumVertices, kNumVertices);
    out.values.assign(values.begin(), values.end());
    finish(out);
}

void LobeShape::finish(Lobe& out) const {
    out.largest = 0.0f;
    for (const float value : out.values) out.largest = std::max(out.largest, std::abs(value));
    out.positions.resize(kNumVertices);
    out.colors.resize(kNumVertices);
    for (size_t n = 0; n < kNumVertices; ++n) {
        const float radius = out.largest > 0.0f ? std::abs(out.values[n]) / out.largest : 0.0f;
        out.positions[n] = radius * directions_[n];
        out.colors[n] = signed_color(out.values[n], out.largest);
    }
}

std::vector<float> vertex_transfer(const TransferLayout& layout, std::span<const float> transfer,
                                   uint32_t vertex, uint32_t channel) {
    PAIM_CHECK_EQ(transfer.size() % layout.num_planes(), size_t{0});
    const size_t num_vertices = transfer.size() / layout.num_planes();
    PAIM_CHECK_LT(size_t{vertex}, num_vertices);
    const std::array<float, 3> weights = channel_weights(layout, channel);
    std::vector<float> coefficients(layout.num_coefficients(), 0.0f);
    for (uint32_t c = 0; c < layout.channels; ++c) {
        for (uint32_t i = 0; i < coefficients.size(); ++i) {
            coefficients[i] += weights[c] * transfer[layout.plane(c, i) * num_vertices + vertex];
        }
    }
    return coefficients;
}

}  // namespace paim::player
