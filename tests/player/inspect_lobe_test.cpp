// Lobes of functions that are known.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>
#include <vector>

#include "paim/sh/basis.h"
#include "player/inspect/false_color.h"
#include "player/inspect/lobe.h"
#include "player/inspect/transfer_channel.h"

namespace paim::player {
namespace {

TEST(LobeShape, IsAClosedSphereThatFacesOutwards) {
    const LobeShape shape(1);
    ASSERT_EQ(shape.directions().size(), size_t{LobeShape::kNumVertices});
    std::map<std::pair<uint32_t, uint32_t>, int> edges;
    double volume = 0.0;
    for (const Triangle& t : shape.triangles()) {
        Vec3d corners[3];
        for (size_t j = 0; j < 3; ++j) {
            corners[j] = shape.directions()[t[j]].cast<double>();
            EXPECT_NEAR(corners[j].norm(), 1.0, 1e-6);
            ++edges[{t[j], t[(j + 1) % 3]}];
        }
        const double part = corners[0].dot(corners[1].cross(corners[2])) / 6.0;
        EXPECT_GT(part, 0.0);
        volume += part;
    }
    // Each edge has a face on both sides. A polyhedron in the sphere of edges of 0.07 lacks less than
    // 0.07² of its volume.
    for (const auto& [edge, count] : edges) {
        EXPECT_EQ(count, 1);
        EXPECT_EQ(edges.count({edge.second, edge.first}), 1u);
    }
    EXPECT_NEAR(volume, 4.0 / 3.0 * kPi, 0.005 * 4.0 / 3.0 * kPi);
}

TEST(LobeShape, OfTheConstantFunctionIsASphere) {
    const LobeShape shape(3);
    Lobe lobe;
    shape.of_basis(0, lobe);
    EXPECT_NEAR(lobe.largest, 0.282095f, 1e-6f);
    for (size_t n = 0; n < LobeShape::kNumVertices; ++n) {
        EXPECT_NEAR(lobe.positions[n].norm(), 1.0f, 1e-6f);
        EXPECT_EQ(lobe.colors[n], signed_color(1.0f, 1.0f));
    }
    shape.of(std::vector<float>{-2.0f}, lobe);
    EXPECT_NEAR(lobe.largest, 2.0f * 0.282095f, 1e-6f);
    EXPECT_NEAR(lobe.positions[7].norm(), 1.0f, 1e-6f);
    EXPECT_EQ(lobe.colors[7], signed_color(-1.0f, 1.0f));
}

// y₁₋₁ ∝ y, y₁₀ ∝ z, y₁₁ ∝ x: two spheres that touch, through the origin.
TEST(LobeShape, OfLinearFunctionsIsTwoLobesOfOppositeColours) {
    const LobeShape shape(2);
    const Vec3f axes[] = {Vec3f::UnitY(), Vec3f::UnitZ(), Vec3f::UnitX()};
    for (uint32_t i = 1; i < 4; ++i) {
        Lobe lobe;
        shape.of_basis(i, lobe);
        size_t num_above = 0, num_below = 0;
        for (size_t n = 0; n < LobeShape::kNumVertices; ++n) {
            const float cosine = shape.directions()[n].dot(axes[i - 1]);
            // The largest cosine of the directions is 1 up to half an edge, 0.04² / 2.
            const Vec3f expected = std::abs(cosine) * shape.directions()[n];
            EXPECT_LT((lobe.positions[n] - expected).norm(), 1e-3f);
            if (std::abs(cosine) < 1e-3f) continue;
            (cosine > 0.0f ? num_above : num_below) += 1;
            const bool is_red = lobe.colors[n].x() > lobe.colors[n].z();
            EXPECT_EQ(is_red, cosine > 0.0f);
        }
        EXPECT_EQ(num_above, num_below);
    }
}

TEST(LobeShape, OfASumIsTheSumOfBasisFunctions) {
    const LobeShape shape(4);
    const std::vector<float> coefficients{0.5f, 0.1f, -0.7f, 0.2f, 0.4f, -0.3f, 0.9f};
    Lobe lobe;
    shape.of(coefficients, lobe);
    float largest = 0.0f;
    for (size_t n = 0; n < LobeShape::kNumVertices; ++n) {
        std::vector<double> basis(16);
        sh::evaluate_basis(4, shape.directions()[n].cast<double>(), basis);
        double sum = 0.0;
        for (size_t i = 0; i < coefficients.size(); ++i) sum += coefficients[i] * basis[i];
        EXPECT_NEAR(lobe.values[n], sum, 1e-5);
        largest = std::max(largest, lobe.positions[n].norm());
        EXPECT_EQ(lobe.colors[n], signed_color(lobe.values[n], lobe.largest));
    }
    EXPECT_NEAR(largest, 1.0f, 1e-6f);
}

TEST(LobeShape, OfNothingIsTheOrigin) {
    const LobeShape shape(2);
    Lobe lobe;
    shape.of_basis(3, lobe);
    shape.of(std::vector<float>(4, 0.0f), lobe);
    EXPECT_EQ(lobe.largest, 0.0f);
    for (const Vec3f& position : lobe.positions) EXPECT_EQ(position, Vec3f(0, 0, 0));
}

TEST(VertexTransfer, TakesOneVertexAndChannel) {
    const TransferLayout grey{TransferKind::diffuse, 2, 1, 1};
    const std::vector<float> planes{0, 1, 2, 3, 4, 5, 6, 7};  // two vertices
    EXPECT_EQ(vertex_transfer(grey, planes, 1, 2), (std::vector<float>{1, 3, 5, 7}));
    const TransferLayout coloured{TransferKind::diffuse, 1, 3, 1};
    const std::vector<float> colours{0, 1, 0, 10, 0, 100};
    EXPECT_EQ(vertex_transfer(coloured, colours, 1, 1), (std::vector<float>{10}));
    EXPECT_NEAR(vertex_transfer(coloured, colours, 1, kLuminance)[0],
                0.2126f + 0.7152f * 10.0f + 0.0722f * 100.0f, 1e-5f);
}

}  // namespace
}  // namespace paim::player
