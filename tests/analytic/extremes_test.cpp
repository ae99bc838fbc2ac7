// The same mesh at other sizes, far from the world's origin, and in another order: the same
// transfer. All through OBJ files, since a float mesh that is far away has already lost its digits.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <numeric>
#include <string>

#include "compressor/bake/transfer_baker.h"
#include "compressor/io/obj_sequence.h"
#include "paim/base/file.h"
#include "paim/base/seed.h"
#include "paim/mesh/bounds.h"
#include "poses/octopus.h"
#include "poses/shapes.h"
#include "tests/temporary_directory.h"

namespace paim {
namespace {

constexpr uint32_t kBands = 5;
constexpr size_t kCoefficients = kBands * kBands;
constexpr size_t kBakes = 8;  // of each side of a comparison, with seeds of their own
constexpr uint32_t kRays = 128;

struct Mesh {
    Topology topology;
    std::vector<Vec3d> positions;
};

Mesh mesh_of(const PoseSet& set) {
    Mesh mesh{set.topology(), {}};
    for (const Vec3f& x : set.load_pose(0).positions) mesh.positions.push_back(x.cast<double>());
    return mesh;
}

Mesh octopus() {
    return mesh_of(poses::make_octopus(1000, 1));
}

Mesh bowl() {
    return mesh_of(poses::make_pose_set(*poses::make_bowl_sequence(600), 1));
}

Mesh mapped(Mesh mesh, const std::function<Vec3d(const Vec3d&)>& map) {
    for (Vec3d& x : mesh.positions) x = map(x);
    return mesh;
}

double size_of(const Mesh& mesh) {
    BoundsD bounds;
    bounds.extend(std::span<const Vec3d>(mesh.positions));
    return bounds.diagonal();
}

// The mesh as a file with all its digits, read back.
class ObjMesh {
  public:
    explicit ObjMesh(const Mesh& mesh) {
        std::string text;
        for (const Vec3d& x : mesh.positions) {
            text += fmt::format("v {:.17g} {:.17g} {:.17g}\n", x.x(), x.y(), x.z());
        }
        for (const Triangle& t : mesh.topology.triangles) {
            text += fmt::format("f {} {} {}\n", t[0] + 1, t[1] + 1, t[2] + 1);
        }
        write_file(directory_ / "x.obj", text);
        source_ =
            std::make_unique<ObjSequence>(std::vector<std::filesystem::path>{directory_ / "x.obj"});
    }
    const ObjSequence& source() const { return *source_; }

    BakedPose bake(uint64_t seed) const {
        return TransferBaker({kBands, kRays, seed})
            .bake(source_->topology(), source_->load_pose(0), 0);
    }

  private:
    TemporaryDirectory directory_;
    std::unique_ptr<ObjSequence> source_;
};

// Mean and variance of the mean of each value over several bakes, [C][V].
struct Estimate {
    std::vector<double> mean, variance;
};

// order  the mesh's vertex for each vertex that is wanted; empty if they are the same
Estimate estimate(const Mesh& mesh, uint64_t first_seed, const std::vector<uint32_t>& order = {}) {
    const ObjMesh obj(mesh);
    const size_t num_vertices = mesh.positions.size();
    const size_t num_values = kCoefficients * num_vertices;
    std::vector<double> sum(num_values, 0.0), square(num_values, 0.0);
    for (size_t j = 0; j < kBakes; ++j) {
        const BakedPose baked = obj.bake(first_seed + j);
        for (size_t r = 0; r < num_values; ++r) {
            const size_t v = r % num_vertices;
            const double t = baked.transfer[r - v + (order.empty() ? v : order[v])];
            sum[r] += t;
            square[r] += t * t;
        }
    }
    Estimate result{sum, square};
    for (size_t r = 0; r < num_values; ++r) {
        result.mean[r] = sum[r] / kBakes;
        const double spread = square[r] / kBakes - result.mean[r] * result.mean[r];
        result.variance[r] = std::max(0.0, spread) / (kBakes - 1);
    }
    return result;
}

// What two estimates of the same thing have apart, in units of their own noise.
struct Distance {
    double per_vertex,
        error;          // mean of t² over the coefficients of a vertex, and its standard error
    double worst_bias;  // largest |z| of a coefficient's difference, summed over all vertices
};

Distance distance(const Estimate& a, const Estimate& b) {
    // Local coordinates are rounded again, to 2^-24 of the size; normals change by that over the
    // length of an edge, 1/30 of the size: 2e-6, and coefficients of five bands by four times as
    // much at most.
    constexpr double kRounding = 1e-5;
    const size_t num_vertices = a.mean.size() / kCoefficients;
    std::vector<double> per_vertex(num_vertices, 0.0);
    double worst_bias = 0.0;
    for (size_t i = 0; i < kCoefficients; ++i) {
        double sum = 0.0, variances = 0.0;
        for (size_t v = 0; v < num_vertices; ++v) {
            const size_t r = i * num_vertices + v;
            const double difference = a.mean[r] - b.mean[r];
            const double variance = a.variance[r] + b.variance[r] + kRounding * kRounding;
            per_vertex[v] += difference * difference / variance / kCoefficients;
            sum += difference;
            variances += variance;
        }
        worst_bias = std::max(worst_bias, std::abs(sum) / std::sqrt(variances));
    }
    double mean = 0.0, square = 0.0;
    for (const double t : per_vertex) mean += t / static_cast<double>(num_vertices);
    for (const double t : per_vertex) square += (t - mean) * (t - mean);
    // Vertices have streams of their own and are independent; the coefficients of one are not.
    const auto n = static_cast<double>(num_vertices);
    return {mean, std::sqrt(square / (n - 1.0) / n), worst_bias};
}

// Compares with what two sets of bakes of the very same mesh have apart, so that nothing is assumed
// about how the noise is distributed.
void expect_same_transfer(const Estimate& changed, const Estimate& a, const Estimate& b,
                          const std::string& what) {
    const Distance null = distance(a, b);
    const Distance here = distance(a, changed);
    // 4.5 standard errors: by chance once in 150,000 comparisons; some of the 25 biases, once in
    // 6,000. The error of both is that of the null, for what differs has errors as large as one
    // likes.
    EXPECT_LT(here.per_vertex - null.per_vertex, 4.5 * std::sqrt(2.0) * null.error)
        << what << ": " << here.per_vertex << " against " << null.per_vertex;
    EXPECT_LT(here.worst_bias, 4.5) << what;
    EXPECT_LT(null.worst_bias, 4.5) << what;
}

class Extremes : public testing::TestWithParam<Mesh (*)()> {
  protected:
    Extremes()
        : mesh_(GetParam()()),
          size_(size_of(mesh_)),
          a_(estimate(mesh_, 100)),
          b_(estimate(mesh_, 200)) {}

    Mesh mesh_;
    double size_;
    Estimate a_, b_;
};

TEST_P(Extremes, AnySizeGivesTheSameTransfer) {
    for (const double scale : {1e-6, 1e-3, 1e3, 1e6}) {
        const Mesh scaled = mapped(mesh_, [&](const Vec3d& x) { return Vec3d(scale * x); });
        expect_same_transfer(estimate(scaled, 300), a_, b_, fmt::format("scale {}", scale));
    }
}

TEST_P(Extremes, AnyPlaceGivesTheSameTransfer) {
    // The last is as far out as single precision is left alone to carry it.
    for (const auto& [direction, sizes] : {std::pair{Vec3d(1, 0, 0), 1e4},
                                           {Vec3d(0, -1, 0), 1e4},
                                           {Vec3d(1, 1, 1), 1e4},
                                           {Vec3d(-0.3, 0.2, 0.9), 1e4},
                                           {Vec3d(0.3, 0.5, -0.8), 1e8},
                                           {Vec3d(-1, 0.5, 0.7), 15.0}}) {
        const Vec3d far = sizes * size_ * direction.normalized();
        const Mesh moved = mapped(mesh_, [&](const Vec3d& x) { return Vec3d(x + far); });
        EXPECT_EQ(ObjMesh(moved).source().origin().isZero(0.0), sizes < 16.0);
        expect_same_transfer(estimate(moved, 300), a_, b_,
                             fmt::format("{} sizes along {} {} {}", sizes, direction.x(),
                                         direction.y(), direction.z()));
    }
}

TEST_P(Extremes, AnyOrderGivesTheSameTransfer) {
    RandomStream random(11);
    const auto shuffle = [&](auto& list) {
        for (size_t i = list.size(); i > 1; --i) {
            std::swap(list[i - 1], list[random.next_u64() % i]);
        }
    };
    std::vector<uint32_t> order(mesh_.positions.size());  // new number of each old vertex
    std::iota(order.begin(), order.end(), 0u);
    shuffle(order);
    Mesh shuffled = mesh_;
    for (size_t v = 0; v < order.size(); ++v) shuffled.positions[order[v]] = mesh_.positions[v];
    for (Triangle& t : shuffled.topology.triangles) {
        t = {order[t[0]], order[t[1]], order[t[2]]};
        std::rotate(t.begin(), t.begin() + random.next_u64() % 3, t.end());
    }
    shuffle(shuffled.topology.triangles);
    expect_same_transfer(estimate(shuffled, 300, order), a_, b_, "shuffled");
}

TEST_P(Extremes, PowersOfTwoChangeNothingAtAll) {
    // Scaling by them is exact, and so is everything that follows: the same rays hit the same
    // faces.
    const std::vector<float> transfer = ObjMesh(mesh_).bake(1).transfer;
    for (const int exponent : {-90, -60, -20, 20, 60, 90, 120}) {
        const double scale = std::ldexp(1.0, exponent);
        const Mesh scaled = mapped(mesh_, [&](const Vec3d& x) { return Vec3d(scale * x); });
        EXPECT_TRUE(ObjMesh(scaled).bake(1).transfer == transfer) << exponent;
    }
}

TEST_P(Extremes, MovesByMultiplesOfTheOriginsStepChangeNothingAtAll) {
    // The origin is rounded to a multiple of the largest power of two below the size, so that moves
    // by such multiples lead to the very same local coordinates. With coordinates that are
    // multiples of 2^-24, doubles hold all sums exactly.
    const double step = std::ldexp(1.0, std::ilogb(size_));
    const Mesh rounded = mapped(
        mesh_, [&](const Vec3d& x) { return Vec3d((0x1p24 * x).array().round() * 0x1p-24); });
    const ObjMesh here(rounded);
    const std::vector<float> transfer = here.bake(1).transfer;
    for (const Vec3d& steps : {Vec3d(10000, 0, 0), Vec3d(-7000, 9001, 123), Vec3d(0, 0, 1 << 20)}) {
        const Vec3d far = step * steps;
        const ObjMesh moved(mapped(rounded, [&](const Vec3d& x) { return Vec3d(x + far); }));
        EXPECT_EQ(moved.source().origin(), far);
        EXPECT_TRUE(moved.source().load_pose(0).positions == here.source().load_pose(0).positions);
        EXPECT_TRUE(moved.bake(1).transfer == transfer);
    }
}

TEST(Extremes, ConvexSpheresDoNotShadowThemselvesWhereverTheyAre) {
    for (const uint32_t num_vertices : {162u, 2562u}) {
        const Mesh sphere =
            mesh_of(poses::make_pose_set(*poses::make_sphere_sequence(num_vertices), 1));
        for (const double scale : {1e-6, 1.0, 1e6}) {
            for (const double sizes : {1e4, 1e8}) {
                const Vec3d far = sizes * scale * size_of(sphere) * Vec3d(0.6, -0.48, 0.64);
                const ObjMesh moved(
                    mapped(sphere, [&](const Vec3d& x) { return Vec3d(scale * x + far); }));
                EXPECT_EQ(moved.bake(1).statistics.occluded, 0u) << num_vertices << ' ' << scale;
            }
        }
    }
}

INSTANTIATE_TEST_SUITE_P(Meshes, Extremes, testing::Values(octopus, bowl),
                         [](const auto& mesh) { return mesh.index == 0 ? "Octopus" : "Bowl"; });

}  // namespace
}  // namespace paim
