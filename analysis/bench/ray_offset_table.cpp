// How many shadow rays go wrong for how far off the surface they start: the table of
// docs/results/ray_offsets.md.
// Based on: Carsten Wächter and Nikolaus Binder, A Fast and Robust Method for Avoiding
//           Self-Intersection, Ray Tracing Gems, 2019 (one of the ways that are compared)
//
// The truth is the limit of an offset that vanishes: double precision against every triangle, from
// 10⁻⁹ of the shortest edge above the vertex. A ray is wrongly occluded (leaked) if it is occluded
// there but not in truth, and wrongly open the other way round. The truth is asked for where the
// ways disagree; on all of a million rays over these meshes it never differed from ways that agree.
//   paim-ray-offsets [OBJ]...      shapes of paim-poses, then one pose a file
#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <bit>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "compressor/bake/ray_offset.h"
#include "compressor/io/obj_sequence.h"
#include "paim/base/parallel.h"
#include "paim/base/seed.h"
#include "paim/cli/run_main.h"
#include "paim/trace/ray_scene.h"
#include "poses/octopus.h"
#include "poses/shapes.h"

namespace paim {
namespace {

constexpr uint32_t kRays = 256;  // per vertex

struct Way {
    std::string name;
    std::vector<Vec3f> starts;      // [V]
    std::vector<float> along_rays;  // [V] how much further, along each ray
};

bool hits(const Vec3d& origin, const Vec3d& d, const Vec3d& a, const Vec3d& b, const Vec3d& c) {
    const Vec3d ab = b - a, ac = c - a, p = d.cross(ac);
    const double determinant = ab.dot(p);
    if (determinant == 0.0) return false;
    const Vec3d s = origin - a;
    const double u = s.dot(p) / determinant;
    if (u < 0.0 || u > 1.0) return false;
    const Vec3d q = s.cross(ab);
    const double v = d.dot(q) / determinant;
    return v >= 0.0 && u + v <= 1.0 && ac.dot(q) / determinant > 0.0;
}

Vec3f cosine_direction(const Vec3f& normal, RandomStream& random) {
    const double z = 2.0 * random.uniform() - 1.0, angle = 2.0 * kPi * random.uniform();
    const double r = std::sqrt(1.0 - z * z);
    const Vec3d on_sphere(r * std::cos(angle), r * std::sin(angle), z);
    return (normal.cast<double>() + on_sphere).normalized().cast<float>();
}

// Their offset: 256 roundings of each coordinate, or 2⁻¹⁶ near 0 (for scenes of size about 1).
float integer_offset(float x, float n) {
    constexpr float kNearZero = 1.0f / 32.0f, kNearZeroOffset = 1.0f / 65536.0f, kSteps = 256.0f;
    if (std::abs(x) < kNearZero) return x + kNearZeroOffset * n;
    const auto steps = static_cast<int32_t>(kSteps * n);
    return std::bit_cast<float>(std::bit_cast<int32_t>(x) + (x < 0.0f ? -steps : steps));
}

std::vector<Way> ways_of(const Topology& topology, const Pose& pose) {
    const size_t num_vertices = pose.positions.size();
    std::vector<Way> ways;
    const auto along_normals = [&](std::string name, const RayOffsetRule& rule) {
        const auto offsets = ray_offsets(topology, pose.positions, rule);
        Way way{std::move(name), pose.positions, std::vector<float>(num_vertices, 0.0f)};
        for (size_t v = 0; v < num_vertices; ++v) way.starts[v] += offsets[v] * pose.normals[v];
        ways.push_back(std::move(way));
    };
    const RayOffsetRule standard;
    for (const double of_edge : {1e-2, 1e-3, 1e-4, 1e-5, 1e-6}) {
        along_normals(fmt::format("edge {:g}", of_edge), {of_edge, standard.of_coordinate});
    }
    for (const double roundings : {0.25, 1.0, 4.0, 16.0}) {
        along_normals(fmt::format("roundings {:g}", roundings), {0.0, roundings});
    }
    for (const double of_edge : {1e-3, 1e-4, 1e-5}) {
        ways.push_back({fmt::format("tnear {:g}", of_edge), pose.positions,
                        ray_offsets(topology, pose.positions, {of_edge, standard.of_coordinate})});
    }
    Way integers{"integers", pose.positions, std::vector<float>(num_vertices, 0.0f)};
    for (size_t v = 0; v < num_vertices; ++v) {
        for (Eigen::Index i = 0; i < 3; ++i) {
            integers.starts[v][i] = integer_offset(pose.positions[v][i], pose.normals[v][i]);
        }
    }
    ways.push_back(std::move(integers));
    return ways;
}

void measure(const std::string& name, const Topology& topology, const Pose& pose) {
    const RayScene scene(topology, pose.positions);
    const std::vector<Way> ways = ways_of(topology, pose);
    const auto edges = ray_offsets(topology, pose.positions, {1.0, 0.0});
    const size_t num_vertices = pose.positions.size();
    const auto is_blocked = [&](const Vec3d& start, const Vec3f& d) {
        return std::any_of(
            topology.triangles.begin(), topology.triangles.end(), [&](const Triangle& t) {
                return hits(start, d.cast<double>(), pose.positions[t[0]].cast<double>(),
                            pose.positions[t[1]].cast<double>(),
                            pose.positions[t[2]].cast<double>());
            });
    };
    std::vector<std::atomic<uint64_t>> leaked(ways.size()), escaped(ways.size());
    std::atomic<uint64_t> num_rays{0}, num_occluded{0};
    parallel_for(num_vertices, 8, [&](size_t begin, size_t end) {
        std::vector<float> occluded(ways.size());
        for (size_t v = begin; v < end; ++v) {
            const Vec3f& normal = pose.normals[v];
            if (normal.isZero(0.0f)) continue;
            RandomStream random(stream_key(5, 0, v));
            const Vec3d start =
                pose.positions[v].cast<double>() + 1e-9 * double{edges[v]} * normal.cast<double>();
            for (uint32_t r = 0; r < kRays; ++r) {
                const Vec3f d = cosine_direction(normal, random);
                for (size_t w = 0; w < ways.size(); ++w) {
                    const Vec3f from = ways[w].starts[v] + ways[w].along_rays[v] * d;
                    scene.occluded(from, &d.x(), &d.y(), &d.z(), 1, &occluded[w]);
                }
                const bool agreed =
                    std::equal(occluded.begin() + 1, occluded.end(), occluded.begin());
                const bool truth = agreed ? occluded[0] != 0.0f : is_blocked(start, d);
                ++num_rays;
                num_occluded += truth ? 1 : 0;
                for (size_t w = 0; w < ways.size(); ++w) {
                    if (occluded[w] != 0.0f && !truth) ++leaked[w];
                    if (occluded[w] == 0.0f && truth) ++escaped[w];
                }
            }
        }
    });
    fmt::print("{}: {} vertices, {} triangles, {} rays, {} occluded\n", name, num_vertices,
               topology.triangles.size(), num_rays.load(), num_occluded.load());
    for (size_t w = 0; w < ways.size(); ++w) {
        const double per_million = 1e6 / static_cast<double>(num_rays.load());
        fmt::print("  {:14} wrongly occluded {:9.1f}  wrongly open {:9.1f}  per million\n",
                   ways[w].name, static_cast<double>(leaked[w]) * per_million,
                   static_cast<double>(escaped[w]) * per_million);
    }
}

}  // namespace
}  // namespace paim

namespace paim {

namespace {

// Files are opened before anything is measured.
int run(int argc, char** argv) {
    std::vector<std::unique_ptr<ObjSequence>> sequences;
    for (int i = 1; i < argc; ++i) {
        sequences.push_back(
            std::make_unique<ObjSequence>(std::vector<std::filesystem::path>{argv[i]}));
    }
    const auto shape = [](const std::string& name, const PoseSet& set, const Vec3f& squash,
                          const Vec3f& move = Vec3f::Zero()) {
        std::vector<Vec3f> positions = set.load_pose(0).positions;
        for (Vec3f& x : positions) x = x.cwiseProduct(squash) + move;
        const PoseSet squashed(set.topology(), {positions});
        measure(name, squashed.topology(), squashed.load_pose(0));
    };
    const Vec3f as_it_is = Vec3f::Ones();
    const auto sphere = [](uint32_t n) {
        return poses::make_pose_set(*poses::make_sphere_sequence(n), 1);
    };
    shape("sphere", sphere(162), as_it_is);
    shape("sphere squashed 1000:1", sphere(2562), {1.0f, 1e-3f, 1.0f});
    shape("cavity", poses::make_pose_set(*poses::make_cavity_sequence(1000), 1), as_it_is);
    shape("bowl", poses::make_pose_set(*poses::make_bowl_sequence(2000), 1), as_it_is);
    shape("octopus", poses::make_octopus(5000, 1), as_it_is);
    // As far out as single precision is left to carry it (paim/mesh/origin.h).
    shape("octopus 15 sizes out", poses::make_octopus(5000, 1), as_it_is, {150.0f, 0.0f, 0.0f});
    for (size_t i = 0; i < sequences.size(); ++i) {
        measure(argv[i + 1], sequences[i]->topology(), sequences[i]->load_pose(0));
    }
    return 0;
}

}  // namespace

}  // namespace paim

int main(int argc, char** argv) {
    std::setvbuf(stdout, nullptr, _IOLBF, 0);
    return paim::cli::run_main("paim-ray-offsets", [&] { return paim::run(argc, argv); });
}
