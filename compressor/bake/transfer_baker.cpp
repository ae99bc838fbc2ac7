// Shadowed transfer of one pose.
// Based on: Sloan, Kautz and Snyder, Precomputed Radiance Transfer for Real-Time Rendering in
//           Dynamic, Low-Frequency Lighting Environments, 2002
#include "compressor/bake/transfer_baker.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <numeric>

#include "compressor/bake/gloss_pass.h"
#include "compressor/bake/noise_target.h"
#include "compressor/bake/pose_bounces.h"
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

// Turns the estimates of the halves into their mean and half their difference, scaled.
void to_mean_and_noise(float noise_scale, std::array<std::vector<float>, 2>& halves) {
    for (size_t r = 0; r < halves[0].size(); ++r) {
        const float a = halves[0][r];
        const float b = halves[1][r];
        halves[0][r] = 0.5f * (a + b);
        halves[1][r] = noise_scale * (a - b);
    }
}

}  // namespace

// The state of baking one pose.
class TransferBaker::PoseBake {
  public:
    // still_mesh  with still_terms, if light bounces
    PoseBake(const TransferBaker& baker, const Topology& topology, const Pose& pose, uint32_t p,
             const Albedo& albedo, const Materials& materials, const StillMesh& still_mesh)
        : baker_(baker),
          options_(baker.options_),
          albedo_(albedo),
          still_mesh_(still_mesh),
          rays_(topology, pose, still_mesh, options_, p),
          gloss_rows_(topology, materials, baker.reflections_),
          lobe_(cosine_lobe_by_coefficient(options_.bands)),
          num_points_(topology.num_vertices, 0),
          information_(topology.num_vertices, 0.0),
          noise_energy_(topology.num_vertices, 0.0) {
        for (auto& half : halves_) half.resize(lobe_.size() * topology.num_vertices, 0.0f);
    }

    // terms  receives those of the bounces, unless nullptr
    BakedPose run(StillTerms* terms) {
        const size_t part = std::max<size_t>(1, kMaxSums / (4 * num_coefficients()));
        for (size_t begin = 0; begin < num_vertices(); begin += part) {
            bake_part(begin, std::min<size_t>(num_vertices(), begin + part));
        }
        if (!gloss_rows_.vertices.empty()) {
            gloss_ = estimate_gloss(rays_, gloss_rows_, *baker_.gloss_layout_, baker_.gloss_basis_);
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
    bool has_closed_form() const { return options_.sampler == SamplerKind::cosine; }
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
        std::span<const double> unoccluded;
        double c = 0.0;
        if (has_closed_form()) {
            sh::evaluate_basis(static_cast<int>(options_.bands),
                               rays_.pose.normals[v].cast<double>(), std::span(work.unoccluded));
            for (size_t i = 0; i < num_coefficients(); ++i) work.unoccluded[i] *= lobe_[i];
            unoccluded = work.unoccluded;
            c = rays_.open_around[v] =
                open_fraction_around(rays_.neighbours, v, rays_.num_rays, rays_.num_occluded);
        }
        if (has_closed_form() && rays_.num_occluded[v] == 0 && c == 1.0) {
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
    void bounce(StillTerms* terms) {
        const GlossRows still_rows(still_mesh_.topology, still_mesh_.materials,
                                   baker_.reflections_);
        const PoseBounces bounces{rays_,           albedo_,
                                  gloss_rows_,     still_mesh_,
                                  still_rows,      baker_.still_terms_,
                                  baker_.layout(), baker_.gloss_layout_};
        num_back_hits_ = add_bounces(bounces, options_.bounces, halves_, gloss_, terms);
    }

    // Transfer is the mean of the halves, and noise half their difference, scaled.
    BakedPose finish() {
        BakedPose baked;
        baked.positions = to_planes(rays_.pose.positions);
        baked.normals = to_planes(rays_.pose.normals);
        const auto noise_scale = static_cast<float>(0.5 * baker_.samplers_.first().noise_scale());
        to_mean_and_noise(noise_scale, halves_);
        baked.transfer = std::move(halves_[0]);
        baked.noise = std::move(halves_[1]);
        to_mean_and_noise(noise_scale, gloss_);
        baked.gloss = std::move(gloss_[0]);
        baked.gloss_noise = std::move(gloss_[1]);
        PoseStatistics& statistics = baked.statistics;
        statistics.rays =
            std::accumulate(rays_.num_rays.begin(), rays_.num_rays.end(), uint64_t{0});
        statistics.occluded =
            std::accumulate(rays_.num_occluded.begin(), rays_.num_occluded.end(), uint64_t{0});
        for (size_t v = 0; v < num_vertices(); ++v) {
            statistics.zero_normals += rays_.has_normal(v) ? 0 : 1;
        }
        statistics.above_target = num_above_target_;
        statistics.back_hits = num_back_hits_;
        const TransferLayout layout = baker_.layout();
        statistics.transfer_rms = rms_by_band(layout, baked.transfer);
        statistics.noise_rms = rms_by_band(layout, baked.noise);
        if (baker_.gloss_layout_) {
            statistics.gloss_rms = rms_by_band(*baker_.gloss_layout_, baked.gloss);
            statistics.gloss_noise_rms = rms_by_band(*baker_.gloss_layout_, baked.gloss_noise);
        }
        return baked;
    }

    const TransferBaker& baker_;
    const BakeOptions& options_;
    const Albedo& albedo_;
    const StillMesh& still_mesh_;
    PoseRays rays_;
    const GlossRows gloss_rows_;
    const std::vector<double> lobe_;  // [C]
    // [planes][V] the estimates of both halves; of one channel until bounced light is added
    std::array<std::vector<float>, 2> halves_;
    std::array<std::vector<float>, 2> gloss_;  // the same of glossy transfer, [planes][R]
    std::vector<uint64_t> num_points_;         // [V] of a half
    std::vector<double> information_;          // [V] noise_target.h
    uint64_t num_back_hits_ = 0;
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

TransferBaker::TransferBaker(const BakeOptions& options, Albedo albedo, StillMesh still_mesh,
                             Materials materials)
    : options_(options),
      albedo_(std::move(albedo)),
      still_mesh_(std::move(still_mesh)),
      materials_(std::move(materials)),
      gloss_layout_(gloss_layout(options_, albedo_, still_mesh_, materials_)),
      samplers_(options),
      basis_(static_cast<int>(options.bands)),
      gloss_basis_(gloss_layout_ ? static_cast<int>(gloss_layout_->in_bands) : 1) {
    PAIM_CHECK(options.rays >= 2 && options.rays % 2 == 0);
    PAIM_CHECK_LE(options.bounces, kMaxBounces);
    if (gloss_layout_) {
        reflections_ = GlossReflections(*gloss_layout_, {&materials_, &still_mesh_.materials});
    }
}

TransferLayout TransferBaker::bake_layout(const BakeOptions& options, const Albedo& albedo,
                                          const StillMesh& still_mesh, const Materials& materials) {
    const bool coloured = is_coloured(albedo) || has_coloured_tint(materials) ||
                          (!still_mesh.empty() && (is_coloured(still_mesh.albedo) ||
                                                   has_coloured_tint(still_mesh.materials)));
    return {TransferKind::diffuse, options.bands, options.bounces > 0 && coloured ? 3u : 1u};
}

std::optional<TransferLayout> TransferBaker::gloss_layout(const BakeOptions& options,
                                                          const Albedo& albedo,
                                                          const StillMesh& still_mesh,
                                                          const Materials& materials) {
    if (materials.empty() && still_mesh.materials.empty()) return {};
    const uint32_t channels = bake_layout(options, albedo, still_mesh, materials).channels;
    const uint32_t in_bands = options.gloss_in_bands, out_bands = options.gloss_out_bands;
    if (in_bands > 0 && out_bands > 0) {
        return TransferLayout{TransferKind::glossy_in_pose, in_bands, channels, out_bands};
    }
    const GlossEnergies energies = gloss_energies(
        {&materials, &still_mesh.materials}, std::max(kMostChosenInBands, kMostChosenOutBands));
    return choose_gloss_layout(energies, in_bands, out_bands, channels);
}

BakedPose TransferBaker::bake_still_mesh() {
    const StillMesh nothing;
    return PoseBake(*this, still_mesh_.topology, still_mesh_.pose, kStillMeshPose,
                    still_mesh_.albedo, still_mesh_.materials, nothing)
        .run(&still_terms_);
}

BakedPose TransferBaker::bake(const Topology& topology, const Pose& pose, uint32_t p) const {
    PAIM_CHECK_EQ(pose.positions.size(), topology.num_vertices);
    PAIM_CHECK_EQ(pose.normals.size(), topology.num_vertices);
    return PoseBake(*this, topology, pose, p, albedo_, materials_, still_mesh_).run(nullptr);
}

}  // namespace paim
