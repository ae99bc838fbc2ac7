// Vertices far from their part come back to it.
#include "paim/mesh/far_vertices.h"

#include <gtest/gtest.h>

#include <numeric>
#include <vector>

#include "paim/mesh/body_size.h"
#include "poses/shapes.h"

namespace paim {
namespace {

class FarVertices : public testing::Test {
  protected:
    FarVertices() : faces_(topology_.triangles.size()) {
        std::iota(faces_.begin(), faces_.end(), 0u);
    }
    // The positions with far vertices drawn in; empty if there are none.
    std::vector<Vec3f> drawn_in() const {
        std::vector<Vec3f> result = positions_;
        if (!draw_in_far_vertices(topology_, faces_, positions_, result)) return {};
        return result;
    }
    std::vector<uint32_t> neighbours_of(uint32_t v) const {
        std::vector<uint32_t> neighbours;
        for (const Triangle& t : topology_.triangles) {
            if (t[0] != v && t[1] != v && t[2] != v) continue;
            for (const uint32_t other : t) {
                if (other != v) neighbours.push_back(other);
            }
        }
        return neighbours;
    }

    const std::unique_ptr<poses::Sequence> sphere_ = poses::make_sphere_sequence(50);
    const Topology topology_ = sphere_->topology();
    std::vector<Vec3f> positions_ = sphere_->positions(0, 1);
    std::vector<uint32_t> faces_;
};

TEST_F(FarVertices, AreNotThoseOfASphere) {
    EXPECT_TRUE(drawn_in().empty());
}

TEST_F(FarVertices, ComeBetweenTheirNeighbours) {
    const std::vector<Vec3f> usual = positions_;
    positions_[7] *= -3e37f;
    const std::vector<Vec3f> result = drawn_in();
    ASSERT_EQ(result.size(), usual.size());
    Vec3d sum = Vec3d::Zero();
    const std::vector<uint32_t> neighbours = neighbours_of(7);
    for (const uint32_t v : neighbours) sum += usual[v].cast<double>();
    EXPECT_EQ(result[7], (sum / static_cast<double>(neighbours.size())).cast<float>());
    for (size_t v = 0; v < usual.size(); ++v) {
        if (v == 7) continue;
        EXPECT_EQ(result[v], usual[v]) << v;
    }
}

TEST_F(FarVertices, WithoutNeighboursInTheSphereComeToItsSurface) {
    std::vector<uint32_t> all = neighbours_of(7);
    all.push_back(7);
    for (const uint32_t v : all) positions_[v] = {100, 0, 0};
    const std::vector<Vec3f> result = drawn_in();
    ASSERT_EQ(result.size(), positions_.size());
    std::vector<Vec3d> points;
    for (const Vec3f& x : positions_) points.push_back(x.cast<double>());
    const Vec3d from_centre = result[7].cast<double>() - median_point(points);
    EXPECT_NEAR(from_centre.norm(), 0.5 * size_of(points), 1e-5);  // rounded to float
    EXPECT_GT(from_centre.x(), 0.99 * from_centre.norm());
    // Its neighbours have others than these.
    EXPECT_LT(result[all[0]].norm(), 1.0f);
}

}  // namespace
}  // namespace paim
