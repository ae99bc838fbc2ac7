// Sphere, box, plates, cavity and bowl.
#include "poses/shapes.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <map>
#include <string_view>
#include <utility>

#include "paim/base/check.h"
#include "paim/base/error.h"
#include "poses/ring_mesh.h"

namespace paim::poses {

namespace {

struct Mesh {
    Topology topology;
    std::vector<Vec3d> positions;
};

// Finds vertices that patches of a mesh share, by an exact key.
template <typename Key>
class Welder {
  public:
    explicit Welder(Mesh& mesh) : mesh_(mesh) {}

    uint32_t vertex(const Key& key, const Vec3d& position) {
        const auto [entry, added] = ids_.try_emplace(key, mesh_.topology.num_vertices);
        if (added) {
            ++mesh_.topology.num_vertices;
            mesh_.positions.push_back(position);
        }
        return entry->second;
    }

  private:
    Mesh& mesh_;
    std::map<Key, uint32_t> ids_;
};

// The whole number >= 1 whose count is nearest to the wanted one.
uint32_t nearest_size(uint32_t wanted, const std::function<double(double)>& count) {
    uint32_t size = 1;
    while (std::abs(count(size + 1) - wanted) < std::abs(count(size) - wanted)) ++size;
    return size;
}

void check_count(std::string_view name, uint32_t num_vertices) {
    if (num_vertices < kMinShapeVertices || num_vertices > kMaxShapeVertices) {
        throw_usage("{}: expected {} to {} vertices, got {}", name, kMinShapeVertices,
                    kMaxShapeVertices, num_vertices);
    }
}

// Every face of the icosahedron cut into size² triangles, pushed out to the unit sphere.
Mesh make_sphere(uint32_t size) {
    const double g = 0.5 * (1.0 + std::sqrt(5.0));
    const std::array<Vec3d, 12> corners{{{-1, g, 0},
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
                                         {-g, 0, 1}}};
    constexpr std::array<Triangle, 20> kFaces{
        {{0, 11, 5},  {0, 5, 1},  {0, 1, 7},  {0, 7, 10}, {0, 10, 11}, {1, 5, 9}, {5, 11, 4},
         {11, 10, 2}, {10, 7, 6}, {7, 1, 8},  {3, 9, 4},  {3, 4, 2},   {3, 2, 6}, {3, 6, 8},
         {3, 8, 9},   {4, 9, 5},  {2, 4, 11}, {6, 2, 10}, {8, 6, 7},   {9, 8, 1}}};
    using Share = std::pair<uint32_t, uint32_t>;  // a corner and its weight
    Mesh mesh;
    Welder<std::array<Share, 3>> welder(mesh);
    for (const Triangle& face : kFaces) {
        const auto vertex = [&](uint32_t i, uint32_t j) {
            std::array<Share, 3> key{{{face[0], size - i - j}, {face[1], i}, {face[2], j}}};
            std::sort(key.begin(), key.end());
            Vec3d position = Vec3d::Zero();
            for (Share& share : key) {
                if (share.second == 0)
                    share.first = 12;  // a corner without weight is no part of it
                else
                    position += share.second * corners[share.first];
            }
            std::sort(key.begin(), key.end());
            return welder.vertex(key, position.normalized());
        };
        auto& triangles = mesh.topology.triangles;
        for (uint32_t i = 0; i < size; ++i) {
            for (uint32_t j = 0; i + j < size; ++j) {
                triangles.push_back({vertex(i, j), vertex(i + 1, j), vertex(i, j + 1)});
                if (i + j + 1 == size) continue;
                triangles.push_back({vertex(i + 1, j), vertex(i + 1, j + 1), vertex(i, j + 1)});
            }
        }
    }
    return mesh;
}

// A square grid of size² cells on [−1, 1]² in the axes u, v, at `center`; facing u × v.
void add_square(uint32_t size, const Vec3d& center, const Vec3d& u, const Vec3d& v, Mesh& mesh,
                Welder<std::array<int, 3>>& welder) {
    const auto vertex = [&](uint32_t i, uint32_t j) {
        // In units of half a cell, so that coordinates of all six sides of a cube are whole.
        const Vec3d doubled = center * size + (2.0 * i - size) * u + (2.0 * j - size) * v;
        const Eigen::Vector3i key = doubled.array().round().matrix().cast<int>();
        return welder.vertex({key.x(), key.y(), key.z()}, doubled / size);
    };
    auto& triangles = mesh.topology.triangles;
    for (uint32_t i = 0; i < size; ++i) {
        for (uint32_t j = 0; j < size; ++j) {
            triangles.push_back({vertex(i, j), vertex(i + 1, j), vertex(i + 1, j + 1)});
            triangles.push_back({vertex(i, j), vertex(i + 1, j + 1), vertex(i, j + 1)});
        }
    }
}

Mesh make_cube(uint32_t size, bool inside_out) {
    Mesh mesh;
    Welder<std::array<int, 3>> welder(mesh);
    for (int axis = 0; axis < 3; ++axis) {
        for (const double side : {-1.0, 1.0}) {
            const Vec3d u = side * Vec3d::Unit((axis + 1) % 3), v = Vec3d::Unit((axis + 2) % 3);
            add_square(size, side * Vec3d::Unit(axis), inside_out ? v : u, inside_out ? u : v, mesh,
                       welder);
        }
    }
    return mesh;
}

// Two plates: the lower one faces up, the upper one down. Heights −1 and 1 are scaled to
// ∓distance/2.
Mesh make_plates(uint32_t size) {
    Mesh mesh;
    Welder<std::array<int, 3>> welder(mesh);
    add_square(size, -Vec3d::UnitY(), Vec3d::UnitZ(), Vec3d::UnitX(), mesh, welder);
    add_square(size, Vec3d::UnitY(), Vec3d::UnitX(), Vec3d::UnitZ(), mesh, welder);
    return mesh;
}

// Ring i of `size` has 6i vertices and lies at the angle i/size · π/2 from the bottom.
Mesh make_bowl(uint32_t size) {
    Mesh mesh;
    auto& [topology, positions] = mesh;
    positions.push_back(-Vec3d::UnitY());
    for (uint32_t i = 1; i <= size; ++i) {
        const double polar_rad = 0.5 * kPi * i / size;
        for (uint32_t j = 0; j < 6 * i; ++j) {
            const double azimuth_rad = 2.0 * kPi * j / (6 * i);
            const double height = i == size ? 0.0 : -std::cos(polar_rad);
            positions.emplace_back(std::sin(polar_rad) * std::sin(azimuth_rad), height,
                                   std::sin(polar_rad) * std::cos(azimuth_rad));
        }
    }
    topology.num_vertices = static_cast<uint32_t>(positions.size());
    // Ring i starts at 1 + 3i(i−1); each of its six sextants has i edges, and i−1 on the ring
    // within.
    const auto vertex = [](uint32_t i, uint32_t j) {
        return i == 0 ? 0 : 1 + 3 * i * (i - 1) + j % (6 * i);
    };
    for (uint32_t i = 1; i <= size; ++i) {
        for (uint32_t sextant = 0; sextant < 6; ++sextant) {
            for (uint32_t j = 0; j < i; ++j) {
                const uint32_t out = sextant * i + j, in = sextant * (i - 1) + j;
                topology.triangles.push_back(
                    {vertex(i, out), vertex(i, out + 1), vertex(i - 1, in)});
                if (j + 1 == i) continue;
                topology.triangles.push_back(
                    {vertex(i, out + 1), vertex(i - 1, in + 1), vertex(i - 1, in)});
            }
        }
    }
    return mesh;
}

double phase_rad(uint32_t p, uint32_t num_poses) {
    PAIM_CHECK_LT(p, num_poses);
    return 2.0 * kPi * p / num_poses;
}

using Motion = std::function<Eigen::Matrix3d(uint32_t p, uint32_t num_poses)>;

// A fixed mesh and one linear map a pose.
class MovedMesh : public Sequence {
  public:
    MovedMesh(Mesh mesh, Motion motion) : mesh_(std::move(mesh)), motion_(std::move(motion)) {}

    const Topology& topology() const override { return mesh_.topology; }
    const Albedo& albedo() const override { return albedo_; }

    std::vector<Vec3f> positions(uint32_t p, uint32_t num_poses) const override {
        const Eigen::Matrix3d map = motion_(p, num_poses);
        std::vector<Vec3f> placed;
        placed.reserve(mesh_.positions.size());
        for (const Vec3d& position : mesh_.positions) {
            placed.push_back((map * position).cast<float>());
        }
        return placed;
    }

  private:
    Mesh mesh_;
    Motion motion_;
    Albedo albedo_;
};

Eigen::Matrix3d turn(uint32_t p, uint32_t num_poses) {
    return Eigen::AngleAxisd(phase_rad(p, num_poses), Vec3d::UnitY()).toRotationMatrix();
}

Eigen::Matrix3d pulse(uint32_t p, uint32_t num_poses) {
    return pulsing_radius(p, num_poses) * Eigen::Matrix3d::Identity();
}

Eigen::Matrix3d part(uint32_t p, uint32_t num_poses) {
    return Vec3d(1.0, 0.5 * plates_distance(p, num_poses), 1.0).asDiagonal();
}

// Form factor of a point below the corner of a parallel rectangle of a by b at distance 1.
double corner_factor(double a, double b) {
    const double ra = std::sqrt(1.0 + a * a), rb = std::sqrt(1.0 + b * b);
    return (a / ra * std::atan(b / ra) + b / rb * std::atan(a / rb)) / (2.0 * kPi);
}

}  // namespace

std::unique_ptr<Sequence> make_sphere_sequence(uint32_t num_vertices) {
    check_count("sphere", num_vertices);
    const auto count = [](double size) { return 10 * size * size + 2; };
    return std::make_unique<MovedMesh>(make_sphere(nearest_size(num_vertices, count)), pulse);
}

std::unique_ptr<Sequence> make_box_sequence(uint32_t num_vertices) {
    check_count("box", num_vertices);
    const auto count = [](double size) { return 6 * size * size + 2; };
    return std::make_unique<MovedMesh>(make_cube(nearest_size(num_vertices, count), false), turn);
}

std::unique_ptr<Sequence> make_plates_sequence(uint32_t num_vertices) {
    check_count("plates", num_vertices);
    const auto count = [](double size) { return 2 * (size + 1) * (size + 1); };
    return std::make_unique<MovedMesh>(make_plates(nearest_size(num_vertices, count)), part);
}

std::unique_ptr<Sequence> make_cavity_sequence(uint32_t num_vertices) {
    check_count("cavity", num_vertices);
    const auto count = [](double size) { return 6 * size * size + 2; };
    return std::make_unique<MovedMesh>(make_cube(nearest_size(num_vertices, count), true), turn);
}

std::unique_ptr<Sequence> make_bowl_sequence(uint32_t num_vertices) {
    check_count("bowl", num_vertices);
    const auto count = [](double size) { return 3 * size * size + 3 * size + 1; };
    return std::make_unique<MovedMesh>(make_bowl(nearest_size(num_vertices, count)), pulse);
}

double plates_distance(uint32_t p, uint32_t num_poses) {
    return 1.0 + 0.5 * std::sin(phase_rad(p, num_poses));
}

double plates_blocked(double x, double z, double distance) {
    double sum = 0.0;
    for (const double a : {1.0 - x, 1.0 + x}) {
        for (const double b : {1.0 - z, 1.0 + z}) sum += corner_factor(a / distance, b / distance);
    }
    return sum;
}

double pulsing_radius(uint32_t p, uint32_t num_poses) {
    return 1.0 + 0.25 * std::sin(phase_rad(p, num_poses));
}

}  // namespace paim::poses
