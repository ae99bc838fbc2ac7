// Bakes of numbers that are known, small enough to be encoded many times over.
#pragma once

#include <cmath>
#include <filesystem>
#include <optional>

#include "analysis/bench/made_up_identity.h"
#include "paim/base/seed.h"
#include "paim/base/vector.h"
#include "paim/format/bake/bake_directory.h"

namespace paim {

struct TargetBake {
    TransferLayout layout{TransferKind::diffuse, 4, 1};
    uint32_t width = 20;  // of a square sheet of vertices
    uint32_t num_poses = 10;
    double noise = 0.001;      // of every value of the transfer, of unit size in band 0
    double band_decay = 1.0;   // energy of a band: (l + 1)^-2 of this
    uint32_t still_from = 99;  // bands that are zero from here on
    double movement = 1.0;     // 0: all poses are alike but for noise
    double scale = 1.0;        // of the transfer
    // A still mesh, too: the sheet at another time, of this noise, twice as large.
    std::optional<double> still_noise = {};
};

// Waves travel over a sheet, and its transfer follows them.
inline BakeReader write_target_bake(const std::filesystem::path& directory,
                                    const TargetBake& bake = {}) {
    const uint32_t n = bake.width;
    const uint32_t num_vertices = n * n;
    Topology topology;
    topology.num_vertices = num_vertices;
    // Numbered without order, so that the local order is another one.
    const auto number = [&](uint32_t x, uint32_t y) {
        return static_cast<uint32_t>((uint64_t{y} * n + x) * 7919 % num_vertices);
    };
    for (uint32_t y = 0; y + 1 < n; ++y) {
        for (uint32_t x = 0; x + 1 < n; ++x) {
            const uint32_t a = number(x, y), b = number(x + 1, y), c = number(x, y + 1),
                           d = number(x + 1, y + 1);
            topology.triangles.push_back({a, b, d});
            topology.triangles.push_back({a, d, c});
        }
    }
    const Albedo albedo;
    std::vector<BakeIdentity::Source> poses;
    for (uint32_t p = 0; p < bake.num_poses; ++p) poses.push_back({"pose", p});
    BakeIdentity identity = made_up_identity(topology, albedo, bake.layout, std::move(poses));
    if (bake.still_noise) identity.still_meshes.push_back({"still", 0});
    const BakeWriter writer(directory, identity, topology, albedo);

    RandomStream random(5);
    const auto gaussian = [&] {
        return std::sqrt(-2.0 * std::log(1.0 - random.uniform())) *
               std::cos(2.0 * kPi * random.uniform());
    };
    const size_t num_values = size_t{bake.layout.num_planes()} * num_vertices;
    const auto make_pose = [&](double time, double relative_noise, double extent) {
        BakedPose pose;
        pose.positions.resize(size_t{3} * num_vertices);
        pose.normals.resize(size_t{3} * num_vertices);
        pose.transfer.resize(num_values);
        pose.noise.resize(num_values);
        for (uint32_t y = 0; y < n; ++y) {
            for (uint32_t x = 0; x < n; ++x) {
                const size_t v = number(x, y);
                const double u = static_cast<double>(x) / n, w = static_cast<double>(y) / n;
                const double wave = std::sin(6.0 * u + time) +
                                    0.4 * std::sin(9.0 * w - 2.0 * time) +
                                    0.1 * std::sin(20.0 * u * w + 3.0 * time);
                // The still mesh is no lattice, whose few coordinates would be rounded by luck.
                const double sway = (extent - 1.0) * 0.1 * wave;
                pose.positions[v] = static_cast<float>(extent * u + sway);
                pose.positions[num_vertices + v] = static_cast<float>(extent * 0.2 * wave);
                pose.positions[2 * num_vertices + v] = static_cast<float>(extent * w - sway);
                pose.normals[num_vertices + v] = 1.0f;
                for (uint32_t j = 0; j < bake.layout.num_planes(); ++j) {
                    const auto i = static_cast<int>(j % bake.layout.num_coefficients());
                    const auto band = static_cast<uint32_t>(sh::band_of(i));
                    if (band >= bake.still_from) continue;
                    const double size = bake.scale * std::pow(band + 1.0, -bake.band_decay);
                    const double noise = bake.scale * relative_noise;
                    const double value =
                        size * (std::cos(j + 2.0 * u) +
                                0.5 * std::sin(wave + 0.7 * j + 3.0 * w) * std::sin(j + 5.0 * u));
                    const size_t at = size_t{j} * num_vertices + v;
                    pose.transfer[at] = static_cast<float>(value + noise * gaussian());
                    pose.noise[at] = static_cast<float>(noise * gaussian());
                }
            }
        }
        pose.statistics.transfer_rms = rms_by_band(bake.layout, pose.transfer);
        pose.statistics.noise_rms = rms_by_band(bake.layout, pose.noise);
        return pose;
    };
    for (uint32_t p = 0; p < bake.num_poses; ++p) {
        writer.write_pose(
            p, make_pose(bake.movement * 2.0 * kPi * p / bake.num_poses, bake.noise, 1.0));
    }
    if (bake.still_noise) {
        writer.write_still_mesh({topology, albedo, make_pose(0.5, *bake.still_noise, 2.0)});
    }
    return BakeReader(directory);
}

}  // namespace paim
