// A bake of any size without tracing a ray: low rank, falling off as animations do, under noise.
#pragma once

#include <cmath>
#include <filesystem>
#include <vector>

#include "analysis/bench/made_up_identity.h"
#include "paim/base/parallel.h"
#include "paim/base/seed.h"
#include "paim/format/bake/bake_directory.h"

namespace paim::bench {

struct SyntheticBake {
    uint32_t num_vertices = 0;
    uint32_t num_poses = 0;
    uint32_t bands = 0;
    float noise = 1e-3f;  // of values of about 1

    static constexpr uint32_t kRank = 8;

    // Writes the directory: 4 bytes a value. Peak memory is a pose a thread.
    void write(const std::filesystem::path& directory) const {
        const Topology topology = strip();
        const Albedo albedo;
        std::vector<BakeIdentity::Source> poses;
        for (uint32_t p = 0; p < num_poses; ++p) {
            poses.push_back({std::to_string(p) + ".obj", p});
        }
        const BakeIdentity identity =
            made_up_identity(topology, albedo, {TransferKind::diffuse, bands, 1}, std::move(poses));
        const BakeWriter writer(directory, identity, topology, albedo);
        parallel_for(num_poses, 1, [&](size_t p, size_t) {
            BakedPose pose;
            pose.positions = values(static_cast<uint32_t>(p), 3, 0);
            pose.normals.assign(size_t{3} * num_vertices, 0.0f);
            pose.transfer = values(static_cast<uint32_t>(p), sh::num_coefficients(bands), 1);
            pose.noise.assign(pose.transfer.size(), noise);
            pose.statistics.transfer_rms.assign(bands, 1.0);
            pose.statistics.noise_rms.assign(bands, noise);
            writer.write_pose(static_cast<uint32_t>(p), pose);
        });
    }

  private:
    Topology strip() const {
        Topology topology{num_vertices, {}};
        for (uint32_t v = 0; v + 2 < num_vertices; ++v) {
            for (const uint32_t other : {v + 1, v + 2}) {  // two a vertex, as in closed meshes
                topology.triangles.push_back({v, other, (other + 1) % num_vertices});
            }
        }
        return topology;
    }

    // in [-1, 1), from 21 bits
    static float centred(uint64_t bits) {
        return static_cast<float>(bits & 0x1fffff) * 0x1p-20f - 1.0f;
    }

    // Plane by plane; each row has kRank numbers of its own, each pose as many weights.
    std::vector<float> values(uint32_t p, uint32_t num_planes, uint64_t part) const {
        float weights[kRank];
        for (uint32_t k = 0; k < kRank; ++k) {
            weights[k] = std::pow(0.6f, static_cast<float>(k)) *
                         std::sin(0.1f * static_cast<float>((k + 1) * p + k));
        }
        std::vector<float> all(size_t{num_planes} * num_vertices);
        for (size_t row = 0; row < all.size(); ++row) {
            float value = noise * centred(stream_key(part, p, row));
            uint64_t bits = 0;
            for (uint32_t k = 0; k < kRank; ++k, bits >>= 21) {
                if (k % 3 == 0) bits = mix_bits(row * 4 + k / 3 + part * 77);
                value += weights[k] * centred(bits);
            }
            all[row] = value;
        }
        return all;
    }
};

}  // namespace paim::bench
