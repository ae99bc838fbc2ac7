// Diffuse shadowed transfer of one pose.
// Based on: Sloan, Kautz and Snyder, Precomputed Radiance Transfer for Real-Time Rendering in Dynamic,
//           Low-Frequency Lighting Environments, 2002; the unoccluded part as control variate after
//           Owen, Monte Carlo Theory, Methods and Examples, 2013, chapter 8.9
#include "compressor/bake/transfer_baker.h"

#include <algorithm>
#include <cmath>

#include "compressor/bake/ray_offset.h"
#include "paim/base/check.h"
#include "paim/base/parallel.h"
#include "paim/base/seed.h"
#include "paim/mesh/planes.h"
#include "paim/sh/cosine_lobe.h"
#include "paim/trace/scene.h"

namespace paim {

namespace {

constexpr uint32_t kBatch = sh::BatchBasis::kBatch;
constexpr size_t kSumLanes = sh::BatchBasis::kSumLanes;
constexpr size_t kVerticesPerPiece = 64;
// Lane sums are single precision; they are emptied into double before rounding matters.
constexpr uint32_t kRaysPerFlush = 32 * kBatch;

// â_l / π for each coefficient, [bands²]: the transfer of an unoccluded vertex is this times y_i(n).
std::vector<double> cosine_lobe_by_coefficient(uint32_t bands) {
    std::vector<double> lobe(size_t{bands} * bands);
    for (size_t i = 0; i < lobe.size(); ++i) {
        lobe[i] = sh::cosine_lobe(sh::band_of(static_cast<int>(i)));
    }
    return lobe;
}

}  // namespace

// One half of a vertex's rays.
struct Half {
    DirectionArrays directions;
    std::vector<float> blocked;  // 1 or 0
    uint32_t num_blocked = 0;
};

struct TransferBaker::Workspace {
    Half halves[2];
    std::vector<float> weights;     // [padded rays]
    std::vector<float> lanes;       // [C][kSumLanes]
    std::vector<double> sums[2];    // [C] of each half
    std::vector<double> at_normal;  // [C] y_i(n)
    std::vector<double> mean;       // [C] the transfer
    std::vector<double> lobe;       // [C]

    Workspace(uint32_t bands, uint32_t num_rays, uint32_t padded_rays)
        : weights(padded_rays, 0.0f),
          lanes(size_t{bands} * bands * kSumLanes),
          at_normal(size_t{bands} * bands),
          mean(at_normal.size()),
          lobe(cosine_lobe_by_coefficient(bands)) {
        for (size_t h = 0; h < 2; ++h) {
            halves[h].blocked.resize(num_rays);
            sums[h].resize(at_normal.size());
        }
    }

    // Σ ((1 − blocked) − open) y_i over the rays of half h.
    void sum(const sh::BatchBasis& basis, size_t h, float open) {
        const Half& half = halves[h];
        const auto num_rays = static_cast<uint32_t>(half.blocked.size());
        // Padding keeps its weight of zero.
        for (uint32_t j = 0; j < num_rays; ++j) weights[j] = (1.0f - half.blocked[j]) - open;
        std::fill(sums[h].begin(), sums[h].end(), 0.0);
        for (uint32_t first = 0; first < num_rays; first += kRaysPerFlush) {
            std::fill(lanes.begin(), lanes.end(), 0.0f);
            const uint32_t end = std::min(num_rays, first + kRaysPerFlush);
            for (uint32_t j = first; j < end; j += kBatch) {
                basis.accumulate(half.directions.x.data() + j, half.directions.y.data() + j,
                                 half.directions.z.data() + j, weights.data() + j, lanes.data());
            }
            for (size_t i = 0; i < mean.size(); ++i) {
                for (size_t lane = 0; lane < kSumLanes; ++lane) {
                    sums[h][i] += static_cast<double>(lanes[i * kSumLanes + lane]);
                }
            }
        }
    }
};

// The transfer of a vertex is left in the workspace; this is what else it found.
struct TransferBaker::Estimate {
    uint32_t num_blocked = 0;
    double energy = 0.0;        // Σ_i t_i²
    double noise_energy = 0.0;  // Σ_i (half the difference of the halves)²
};

TransferBaker::TransferBaker(const BakeOptions& options)
    : options_(options), directions_(options.rays / 2), basis_(static_cast<int>(options.bands)) {
    PAIM_CHECK(options.rays >= 2 && options.rays % 2 == 0);
}

TransferBaker::Estimate TransferBaker::estimate(const Scene& scene, const Vec3f& origin,
                                                const Vec3f& normal, uint32_t p, uint32_t v,
                                                Workspace& work) const {
    const uint32_t num_rays = directions_.count();
    Estimate result;
    for (uint32_t h = 0; h < 2; ++h) {
        Half& half = work.halves[h];
        directions_.generate(normal, stream_key(options_.seed, p, v, h), half.directions);
        half.num_blocked = scene.blocked(origin, half.directions.x.data(), half.directions.y.data(),
                                         half.directions.z.data(), num_rays, half.blocked.data());
        result.num_blocked += half.num_blocked;
    }
    sh::evaluate_basis(static_cast<int>(options_.bands), normal.cast<double>(),
                       std::span(work.at_normal));
    const bool all_open = result.num_blocked == 0;
    const bool all_blocked = result.num_blocked == 2 * num_rays;
    const bool partly = !all_open && !all_blocked;
    double open[2];  // of each half, what the other one says; rounded as the weights are
    for (size_t h = 0; h < 2; ++h) {
        const double blocked = static_cast<double>(work.halves[1 - h].num_blocked) / num_rays;
        const auto rounded = static_cast<float>(1.0 - blocked);
        open[h] = static_cast<double>(rounded);
        if (partly) work.sum(basis_, h, rounded);
    }
    for (size_t i = 0; i < work.mean.size(); ++i) {
        const double unoccluded = work.lobe[i] * work.at_normal[i];
        double estimates[2];
        for (size_t h = 0; h < 2; ++h) {
            estimates[h] = open[h] * unoccluded + (partly ? work.sums[h][i] / num_rays : 0.0);
        }
        work.mean[i] = 0.5 * (estimates[0] + estimates[1]);
        const double error = 0.5 * (estimates[0] - estimates[1]);
        result.energy += work.mean[i] * work.mean[i];
        result.noise_energy += error * error;
    }
    return result;
}

BakedPose TransferBaker::bake(const Topology& topology, const Pose& pose, uint32_t p) const {
    const uint32_t num_vertices = topology.num_vertices;
    PAIM_CHECK_EQ(pose.positions.size(), num_vertices);
    PAIM_CHECK_EQ(pose.normals.size(), num_vertices);
    const Scene scene(topology, pose.positions);
    const std::vector<float> offsets = ray_offsets(topology, pose.positions);
    const size_t num_planes = layout().num_planes();

    BakedPose baked;
    baked.positions = to_planes(pose.positions);
    baked.normals = to_planes(pose.normals);
    baked.transfer.resize(num_planes * num_vertices, 0.0f);
    std::vector<Estimate> estimates(num_vertices);
    std::vector<uint8_t> has_normal(num_vertices, 0);
    parallel_for(num_vertices, kVerticesPerPiece, [&](size_t begin, size_t end) {
        Workspace work(options_.bands, directions_.count(), directions_.padded_count());
        for (size_t v = begin; v < end; ++v) {
            const Vec3f& normal = pose.normals[v];
            if (normal.isZero(0.0f)) continue;
            has_normal[v] = 1;
            estimates[v] = estimate(scene, pose.positions[v] + offsets[v] * normal, normal, p,
                                    static_cast<uint32_t>(v), work);
            for (size_t i = 0; i < num_planes; ++i) {
                baked.transfer[i * num_vertices + v] = static_cast<float>(work.mean[i]);
            }
        }
    });

    PoseStatistics& statistics = baked.statistics;
    double energy = 0.0;
    double noise_energy = 0.0;
    for (size_t v = 0; v < num_vertices; ++v) {
        statistics.blocked += estimates[v].num_blocked;
        statistics.zero_normals += has_normal[v] ? 0 : 1;
        energy += estimates[v].energy;
        noise_energy += estimates[v].noise_energy;
    }
    statistics.rays = uint64_t{num_vertices - statistics.zero_normals} * 2 * directions_.count();
    const double num_values = static_cast<double>(num_planes) * num_vertices;
    statistics.transfer_rms = std::sqrt(energy / num_values);
    statistics.noise_rms = std::sqrt(noise_energy / num_values);
    return baked;
}

}  // namespace paim
