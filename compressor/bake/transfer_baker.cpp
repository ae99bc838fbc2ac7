// Diffuse shadowed transfer of one pose.
// Based on: Sloan, Kautz and Snyder, Precomputed Radiance Transfer for Real-Time Rendering in
//           Dynamic, Low-Frequency Lighting Environments, 2002
#include "compressor/bake/transfer_baker.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <numeric>

#include "compressor/bake/noise_target.h"
#include "compressor/bake/pose_rays.h"
#include "compressor/bake/split_estimate.h"
#include "paim/base/check.h"
#include "paim/base/parallel.h"
#include "paim/mesh/planes.h"
#include "paim/sh/cosine_lobe.h"

namespace paim {

namespace {

constexpr size_t kVerticesPerPiece = 64;
// Number of sums that are kept until the neighbours have traced their rays, 64 MB. A larger mesh is
// baked in parts.
constexpr size_t kMaxSums = size_t{1} << 23;

// â_l / π for each coefficient, [bands²]. The transfer of an unoccluded vertex is this times
// y_i(n).
std::vector<double> cosine_lobe_by_coefficient(uint32_t bands) {
    std::vector<double> lobe(TransferLayout{TransferKind::diffuse, bands}.num_coefficients());
    for (size_t i = 0; i < lobe.size(); ++i) {
        lobe[i] = sh::cosine_lobe(sh::band_of(static_cast<int>(i)));
    }
    return lobe;
}

using Halves = std::array<SplitEstimate, 2>;

// Points of a half in the first round with a noise target: two packets of rays. Others have powers
// of two and what is half-way between them, so that there are few sizes.
constexpr uint32_t kFirstPoints = 32;

uint32_t next_size(uint32_t points) {
    return points + (std::has_single_bit(points) ? points / 2 : points / 3);
}

// Points of a half of a vertex's next round: at least as many as wanted, and half of those traced
// already, so that rounds are few; if that is more than the vertex may have, the largest size that it
// may. 0: fewer than the smallest size are left.
uint32_t points_of_round(double wanted, uint64_t traced, uint64_t limit) {
    wanted = std::max(wanted, 0.5 * static_cast<double>(traced));
    const uint64_t left = limit - traced;
    uint32_t points = kFirstPoints;
    while (points < wanted && next_size(points) <= left) points = next_size(points);
    return points <= left ? points : 0;
}

}  // namespace

// The state of baking one pose.
class TransferBaker::PoseBake {
  public:
    // still_mesh  with still_terms, if light bounces
    PoseBake(const TransferBaker& baker, const Topology& topology, const Pose& pose, uint32_t p,
             const Albedo& albedo, const StillMesh& still_mesh)
        : baker_(baker),
          options_(baker.options_),
          albedo_(albedo),
          still_mesh_(still_mesh),
          rays_(topology, pose, still_mesh, options_, p),
          lobe_(cosine_lobe_by_coefficient(options_.bands)),
          num_points_(topology.num_vertices, 0),
          information_(topology.num_vertices, 0.0),
          noise_energy_(topology.num_vertices, 0.0) {
        for (auto& half : halves_) half.resize(lobe_.size() * topology.num_vertices, 0.0f);
    }

    // terms  receives those of the bounces, unless nullptr
    BakedPose run(BounceTerms* terms) {
        const size_t part = std::max<size_t>(1, kMaxSums / (4 * num_coefficients()));
        for (size_t begin = 0; begin < num_vertices(); begin += part) {
            bake_part(begin, std::min<size_t>(num_vertices(), begin + part));
        }
        if (options_.bounces > 0) bounce(terms);
        return finish();
    }

  private:
    struct Workspace {
        SplitTracer tracers[2];
        std::vector<double> unoccluded;                // [C]
        std::array<std::vector<double>, 2> estimates;  // [C]

        Workspace(const sh::BatchBasis& basis, size_t num_coefficients)
            : tracers{SplitTracer(basis), SplitTracer(basis)},
              unoccluded(num_coefficients),
              estimates{unoccluded, unoccluded} {}
    };

    // The next round of rays of a vertex.
    struct NextRound {
        uint32_t vertex;
        const DirectionSampler* sampler;
    };

    size_t num_coefficients() const { return lobe_.size(); }
    size_t num_vertices() const { return rays_.num_vertices(); }
    double weight(const DirectionSampler& sampler) const { return rays_.rounds.weight(sampler); }

    // Traces another round of a vertex's rays. If it is the only one, rays that are all open or all
    // occluded are not added up: mostly, nothing depends on their sums.
    void shoot(const NextRound& next, size_t round, bool is_only_round, Halves& halves,
               Workspace& work) {
        const size_t v = next.vertex;
        const RayStart start = rays_.starts[v];
        for (uint32_t h = 0; h < 2; ++h) {
            work.tracers[h].trace(rays_.scene, start, rays_.pose.normals[v], *next.sampler,
                                  rays_.rounds.keys(v, round), h, halves[h]);
        }
        rays_.num_rays[v] = halves[0].num_rays + halves[1].num_rays;
        rays_.num_occluded[v] = halves[0].num_occluded + halves[1].num_occluded;
        num_points_[v] += next.sampler->num_points();
        information_[v] += std::pow(2.0 * next.sampler->num_points(), rays_.rounds.power());
        const bool all_alike =
            rays_.num_occluded[v] == 0 || rays_.num_occluded[v] == rays_.num_rays[v];
        if (is_only_round && all_alike) return;
        for (size_t h = 0; h < 2; ++h) work.tracers[h].add(weight(*next.sampler), halves[h]);
    }

    // Writes the estimates of both halves from their present sums.
    void estimate(const NextRound& next, size_t round, Halves& halves, Workspace& work) {
        const size_t v = next.vertex;
        const bool has_closed_form = options_.sampler == SamplerKind::cosine;
        std::span<const double> unoccluded;
        double c = 0.0;
        if (has_closed_form) {
            sh::evaluate_basis(static_cast<int>(options_.bands),
                               rays_.pose.normals[v].cast<double>(), std::span(work.unoccluded));
            for (size_t i = 0; i < num_coefficients(); ++i) work.unoccluded[i] *= lobe_[i];
            unoccluded = work.unoccluded;
            c = rays_.open_fraction_around(v);
        }
        if (has_closed_form && rays_.num_occluded[v] == 0 && c == 1.0) {
            for (auto& half : work.estimates) half = work.unoccluded;
        } else if (rays_.num_occluded[v] == rays_.num_rays[v] && c == 0.0) {
            for (auto& half : work.estimates) std::fill(half.begin(), half.end(), 0.0);
        } else {
            for (uint32_t h = 0; h < 2; ++h) {
                if (halves[h].num_points == 0.0) {
                    work.tracers[h].assume(rays_.pose.normals[v], *next.sampler,
                                           rays_.rounds.keys(v, round), h,
                                           rays_.num_occluded[v] > 0);
                    work.tracers[h].add(weight(*next.sampler), halves[h]);
                }
                estimate_half(halves[h], unoccluded, c, work.estimates[h]);
            }
        }
        double energy = 0.0;
        for (size_t i = 0; i < num_coefficients(); ++i) {
            const double a = work.estimates[0][i];
            const double b = work.estimates[1][i];
            halves_[0][i * num_vertices() + v] = static_cast<float>(a);
            halves_[1][i * num_vertices() + v] = static_cast<float>(b);
            energy += (a - b) * (a - b);
        }
        const double scale = 0.5 * baker_.samplers_.first().noise_scale();
        noise_energy_[v] = scale * scale * energy;
    }

    void bake_part(size_t begin, size_t end) {
        const bool has_target = options_.transfer_error > 0.0;
        const DirectionSampler* const first_sampler = &baker_.samplers_.first();
        std::vector<NextRound> next;
        for (size_t v = begin; v < end; ++v) {
            if (rays_.has_normal(v)) next.push_back({static_cast<uint32_t>(v), first_sampler});
        }
        std::vector<Halves> sums(end - begin, Halves{SplitEstimate(num_coefficients()),
                                                     SplitEstimate(num_coefficients())});
        const auto for_each_next = [&](const auto& run) {
            parallel_for(next.size(), kVerticesPerPiece, [&](size_t first, size_t last) {
                Workspace work(baker_.basis_, num_coefficients());
                for (size_t j = first; j < last; ++j)
                    run(next[j], sums[next[j].vertex - begin], work);
            });
        };
        for (size_t round = 0; !next.empty(); ++round) {
            for (const NextRound& n : next) rays_.rounds.add(n.vertex, round, *n.sampler);
            for_each_next([&](const NextRound& n, Halves& halves, Workspace& work) {
                shoot(n, round, !has_target, halves, work);
            });
            for_each_next([&](const NextRound& n, Halves& halves, Workspace& work) {
                estimate(n, round, halves, work);
            });
            if (!has_target) break;
            next = next_rounds(next);
        }
    }

    // The rounds of those vertices that are above the noise target and may have more rays.
    std::vector<NextRound> next_rounds(const std::vector<NextRound>& done) {
        const double target = options_.transfer_error * open_transfer_norm(options_.bands);
        std::vector<uint32_t> vertices(done.size());
        for (size_t j = 0; j < done.size(); ++j) vertices[j] = done[j].vertex;
        std::vector<NextRound> next;
        for (const RayDemand& demand :
             above_noise_target(rays_.neighbours, noise_energy_, information_, rays_.rounds.power(),
                                target * target, vertices)) {
            const uint32_t points =
                points_of_round(0.5 * demand.rays, num_points_[demand.vertex], options_.rays / 2);
            if (points > 0) {
                next.push_back({demand.vertex, &baker_.samplers_.of(points)});
            } else {
                ++num_above_target_;
            }
        }
        return next;
    }

    // Adds bounced light to the estimates of the halves, by the same rays.
    void bounce(BounceTerms* terms) {
        Topology topology = rays_.topology;
        topology.append(still_mesh_.topology);
        std::vector<Vec3f> positions = rays_.pose.positions;
        positions.insert(positions.end(), still_mesh_.pose.positions.begin(),
                         still_mesh_.pose.positions.end());
        std::vector<uint32_t> num_back_hits[2];
        for (auto& counts : num_back_hits) counts.resize(num_vertices(), 0);
        BounceScene scene;
        scene.layout = baker_.layout();
        scene.num_vertices = num_vertices();
        scene.albedo = albedo_;
        scene.num_still_vertices = still_mesh_.topology.num_vertices;
        scene.still_albedo = still_mesh_.albedo;
        scene.still_terms = &baker_.still_terms_;
        scene.make_row = [&](size_t v, size_t half, TransportRow& row) {
            row.clear();
            if (rays_.num_occluded[v] == 0) return;
            const Vec3f& normal = rays_.pose.normals[v];
            const auto vertex = static_cast<uint32_t>(v);
            const RayStart start = rays_.starts[v];
            HitTracer tracer(rays_.scene, topology, positions);
            rays_.rounds.for_each(
                v, [&](const DirectionSampler& sampler, const HalfKeys& keys, double weight) {
                    tracer.trace(vertex, start, normal, sampler, keys, static_cast<uint32_t>(half),
                                 weight);
                });
            num_back_hits[half][v] = tracer.num_back_hits();
            tracer.end(row);
        };
        BounceTerms bounced = add_bounces(scene, options_.bounces, halves_, terms != nullptr);
        if (terms != nullptr) *terms = std::move(bounced);
        for (const auto& counts : num_back_hits) {
            num_all_back_hits_ = std::accumulate(counts.begin(), counts.end(), num_all_back_hits_);
        }
    }

    // Turns the estimates of the halves into transfer (their mean) and noise (half their
    // difference, scaled).
    BakedPose finish() {
        BakedPose baked;
        baked.positions = to_planes(rays_.pose.positions);
        baked.normals = to_planes(rays_.pose.normals);
        const auto noise_scale = static_cast<float>(0.5 * baker_.samplers_.first().noise_scale());
        for (size_t r = 0; r < halves_[0].size(); ++r) {
            const float a = halves_[0][r];
            const float b = halves_[1][r];
            halves_[0][r] = 0.5f * (a + b);
            halves_[1][r] = noise_scale * (a - b);
        }
        baked.transfer = std::move(halves_[0]);
        baked.noise = std::move(halves_[1]);
        PoseStatistics& statistics = baked.statistics;
        statistics.rays =
            std::accumulate(rays_.num_rays.begin(), rays_.num_rays.end(), uint64_t{0});
        statistics.occluded =
            std::accumulate(rays_.num_occluded.begin(), rays_.num_occluded.end(), uint64_t{0});
        for (size_t v = 0; v < num_vertices(); ++v) {
            statistics.zero_normals += rays_.has_normal(v) ? 0 : 1;
        }
        statistics.above_target = num_above_target_;
        statistics.back_hits = num_all_back_hits_;
        const TransferLayout layout = baker_.layout();
        statistics.transfer_rms = rms_by_band(layout, baked.transfer);
        statistics.noise_rms = rms_by_band(layout, baked.noise);
        return baked;
    }

    const TransferBaker& baker_;
    const BakeOptions& options_;
    const Albedo& albedo_;
    const StillMesh& still_mesh_;
    PoseRays rays_;
    const std::vector<double> lobe_;  // [C]
    // [planes][V] the estimates of both halves; of one channel until bounced light is added
    std::array<std::vector<float>, 2> halves_;
    std::vector<uint64_t> num_points_;  // [V] of a half
    std::vector<double> information_;   // [V] noise_target.h
    uint64_t num_all_back_hits_ = 0;
    std::vector<double> noise_energy_;  // [V] Σ_i noise²
    uint32_t num_above_target_ = 0;
};

TransferBaker::Samplers::Samplers(const BakeOptions& options)
    : kind_(options.sampler), relation_(half_relation(options)) {
    first_points_ = options.rays / 2;
    if (options.transfer_error > 0.0) first_points_ = std::min(first_points_, kFirstPoints);
}

const DirectionSampler& TransferBaker::Samplers::of(uint32_t num_points) const {
    const std::lock_guard lock(mutex_);
    auto& sampler = by_size_[num_points];
    if (sampler == nullptr) sampler = make_sampler(kind_, num_points, relation_);
    return *sampler;
}

TransferBaker::TransferBaker(const BakeOptions& options, Albedo albedo, StillMesh still_mesh)
    : options_(options),
      albedo_(std::move(albedo)),
      still_mesh_(std::move(still_mesh)),
      samplers_(options),
      basis_(static_cast<int>(options.bands)) {
    PAIM_CHECK(options.rays >= 2 && options.rays % 2 == 0);
    PAIM_CHECK_LE(options.bounces, kMaxBounces);
}

TransferLayout TransferBaker::bake_layout(const BakeOptions& options, const Albedo& albedo,
                                          const StillMesh& still_mesh) {
    const bool coloured =
        is_coloured(albedo) || (!still_mesh.empty() && is_coloured(still_mesh.albedo));
    return {TransferKind::diffuse, options.bands, options.bounces > 0 && coloured ? 3u : 1u};
}

BakedPose TransferBaker::bake_still_mesh() {
    const StillMesh nothing;
    return PoseBake(*this, still_mesh_.topology, still_mesh_.pose, kStillMeshPose,
                    still_mesh_.albedo, nothing)
        .run(&still_terms_);
}

BakedPose TransferBaker::bake(const Topology& topology, const Pose& pose, uint32_t p) const {
    PAIM_CHECK_EQ(pose.positions.size(), topology.num_vertices);
    PAIM_CHECK_EQ(pose.normals.size(), topology.num_vertices);
    return PoseBake(*this, topology, pose, p, albedo_, still_mesh_).run(nullptr);
}

}  // namespace paim
