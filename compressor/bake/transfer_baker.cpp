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
#include "compressor/bake/ray_start.h"
#include "compressor/bake/split_estimate.h"
#include "paim/base/check.h"
#include "paim/base/parallel.h"
#include "paim/mesh/planes.h"
#include "paim/sh/cosine_lobe.h"
#include "paim/trace/ray_scene.h"

namespace paim {

namespace {

constexpr size_t kVerticesPerPiece = 64;
// Points of a half in the first batch with a noise target: two packets of rays.
constexpr uint32_t kFirstBatch = 32;
// Number of sums that are kept between batches, 256 MB. A larger mesh is baked in pieces.
constexpr size_t kMaxSums = size_t{1} << 25;

std::vector<std::unique_ptr<DirectionSampler>> make_batches(const BakeOptions& options) {
    std::vector<std::unique_ptr<DirectionSampler>> batches;
    const uint32_t num_points = options.rays / 2;
    if (options.transfer_error <= 0.0) {
        batches.push_back(make_sampler(options.sampler, 0, num_points));
        return batches;
    }
    // Batches end at powers of two, where the points are a net, and half-way between these.
    uint32_t end = kFirstBatch;
    for (uint32_t first = 0; first < num_points;
         end += std::has_single_bit(end) ? end / 2 : end / 3) {
        end = std::min(end, num_points);
        batches.push_back(make_sampler(options.sampler, first, end - first));
        first = end;
    }
    return batches;
}

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

}  // namespace

// The state of baking one pose.
class TransferBaker::PoseBake {
  public:
    // still_mesh  with still_terms, if light bounces
    PoseBake(const TransferBaker& baker, const Topology& topology, const Pose& pose, uint32_t p,
             const Albedo& albedo, const StillMesh& still_mesh)
        : baker_(baker),
          options_(baker.options_),
          topology_(topology),
          pose_(pose),
          p_(p),
          albedo_(albedo),
          still_mesh_(still_mesh),
          scene_(topology, pose.positions, still_mesh.topology, still_mesh.pose.positions),
          starts_(topology, pose.positions, pose.normals),
          lobe_(cosine_lobe_by_coefficient(options_.bands)),
          num_rays_(topology.num_vertices),
          num_occluded_(topology.num_vertices),
          num_batches_(topology.num_vertices, 0),
          noise_energy_(topology.num_vertices) {
        for (auto& half : halves_) half.resize(lobe_.size() * topology.num_vertices, 0.0f);
    }

    // terms  receives those of the bounces, unless nullptr
    BakedPose run(BounceTerms* terms) {
        if (options_.transfer_error > 0.0) {
            bake_to_target();
        } else {
            bake_at_once();
        }
        if (options_.bounces > 0) bounce(terms);
        return finish();
    }

  private:
    struct Workspace {
        SplitTracer tracers[2];
        std::vector<double> unoccluded;  // [C]
        std::vector<double> estimates;   // [2][C]

        Workspace(const sh::BatchBasis& basis, size_t num_coefficients)
            : tracers{SplitTracer(basis), SplitTracer(basis)},
              unoccluded(num_coefficients),
              estimates(2 * num_coefficients) {}
    };

    size_t num_coefficients() const { return lobe_.size(); }
    bool has_normal(size_t v) const { return !pose_.normals[v].isZero(0.0f); }

    // Traces another batch of a vertex's rays. Adds them up only if the result depends on their
    // sums.
    void shoot(size_t v, const DirectionSampler& batch, bool is_only_batch, Halves& halves,
               Workspace& work) const {
        const Vec3f& normal = pose_.normals[v];
        const RayStart start = starts_[v];
        for (uint32_t h = 0; h < 2; ++h) {
            const uint64_t key = half_key(options_, p_, static_cast<uint32_t>(v), h);
            work.tracers[h].trace(scene_, start, normal, batch, key, halves[h]);
        }
        const uint64_t num_rays = halves[0].num_rays + halves[1].num_rays;
        const uint64_t num_occluded = halves[0].num_occluded + halves[1].num_occluded;
        const bool has_closed_form = options_.sampler == SamplerKind::cosine;
        const bool needs_no_sums =
            is_only_batch && (num_occluded == num_rays || (num_occluded == 0 && has_closed_form));
        if (needs_no_sums) return;
        for (size_t h = 0; h < 2; ++h) work.tracers[h].add(halves[h]);
    }

    // Writes the estimates of both halves from their present sums.
    void estimate(size_t v, const Halves& halves, Workspace& work) {
        std::span<const double> unoccluded;
        if (options_.sampler == SamplerKind::cosine) {
            sh::evaluate_basis(static_cast<int>(options_.bands), pose_.normals[v].cast<double>(),
                               std::span(work.unoccluded));
            for (size_t i = 0; i < num_coefficients(); ++i) work.unoccluded[i] *= lobe_[i];
            unoccluded = work.unoccluded;
        }
        estimate_split(std::span<const SplitEstimate, 2>(halves), unoccluded, work.estimates);
        double energy = 0.0;
        for (size_t i = 0; i < num_coefficients(); ++i) {
            const double a = work.estimates[i];
            const double b = work.estimates[num_coefficients() + i];
            halves_[0][i * topology_.num_vertices + v] = static_cast<float>(a);
            halves_[1][i * topology_.num_vertices + v] = static_cast<float>(b);
            energy += 0.25 * (a - b) * (a - b);
        }
        noise_energy_[v] = energy;
        ++num_batches_[v];
        num_rays_[v] = halves[0].num_rays + halves[1].num_rays;
        num_occluded_[v] = halves[0].num_occluded + halves[1].num_occluded;
    }

    void bake_at_once() {
        parallel_for(topology_.num_vertices, kVerticesPerPiece, [&](size_t begin, size_t end) {
            Workspace work(baker_.basis_, num_coefficients());
            for (size_t v = begin; v < end; ++v) {
                if (!has_normal(v)) continue;
                Halves halves{SplitEstimate(num_coefficients()), SplitEstimate(num_coefficients())};
                shoot(v, *baker_.batches_[0], true, halves, work);
                estimate(v, halves, work);
            }
        });
    }

    void bake_to_target() {
        const size_t part = std::max<size_t>(1, kMaxSums / (4 * num_coefficients()));
        for (size_t begin = 0; begin < topology_.num_vertices; begin += part) {
            bake_part_to_target(begin, std::min<size_t>(topology_.num_vertices, begin + part));
        }
    }

    void bake_part_to_target(size_t begin, size_t end) {
        const double target = options_.transfer_error * open_transfer_norm(options_.bands);
        const double power = error_power(options_.sampler);
        std::vector<uint32_t> active;
        for (size_t v = begin; v < end; ++v) {
            if (has_normal(v)) active.push_back(static_cast<uint32_t>(v));
        }
        std::vector<Halves> sums(end - begin, Halves{SplitEstimate(num_coefficients()),
                                                     SplitEstimate(num_coefficients())});
        for (const auto& batch : baker_.batches_) {
            if (active.empty()) break;
            parallel_for(active.size(), kVerticesPerPiece, [&](size_t first, size_t last) {
                Workspace work(baker_.basis_, num_coefficients());
                for (size_t j = first; j < last; ++j) {
                    Halves& halves = sums[active[j] - begin];
                    shoot(active[j], *batch, false, halves, work);
                    estimate(active[j], halves, work);
                }
            });
            active = above_noise_target(topology_, noise_energy_, num_rays_, power, target * target,
                                        active);
        }
        num_above_target_ += static_cast<uint32_t>(active.size());
    }

    // Adds bounced light to the estimates of the halves, by the same rays.
    void bounce(BounceTerms* terms) {
        Topology topology = topology_;
        topology.append(still_mesh_.topology);
        std::vector<Vec3f> positions = pose_.positions;
        positions.insert(positions.end(), still_mesh_.pose.positions.begin(),
                         still_mesh_.pose.positions.end());
        std::vector<uint32_t> num_back_hits[2];
        for (auto& counts : num_back_hits) counts.resize(topology_.num_vertices, 0);
        BounceScene scene;
        scene.layout = baker_.layout();
        scene.num_vertices = topology_.num_vertices;
        scene.albedo = albedo_;
        scene.num_still_vertices = still_mesh_.topology.num_vertices;
        scene.still_albedo = still_mesh_.albedo;
        scene.still_terms = &baker_.still_terms_;
        scene.make_row = [&](size_t v, size_t half, TransportRow& row) {
            row.clear();
            if (num_occluded_[v] == 0) return;
            const Vec3f& normal = pose_.normals[v];
            const auto vertex = static_cast<uint32_t>(v);
            const RayStart start = starts_[v];
            const uint64_t key = half_key(options_, p_, vertex, static_cast<uint32_t>(half));
            HitTracer tracer(scene_, topology, positions);
            for (size_t b = 0; b < num_batches_[v]; ++b) {
                tracer.trace(vertex, start, normal, *baker_.batches_[b], key);
            }
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
    // difference).
    BakedPose finish() {
        BakedPose baked;
        baked.positions = to_planes(pose_.positions);
        baked.normals = to_planes(pose_.normals);
        for (size_t r = 0; r < halves_[0].size(); ++r) {
            const float a = halves_[0][r];
            const float b = halves_[1][r];
            halves_[0][r] = 0.5f * (a + b);
            halves_[1][r] = 0.5f * (a - b);
        }
        baked.transfer = std::move(halves_[0]);
        baked.noise = std::move(halves_[1]);
        PoseStatistics& statistics = baked.statistics;
        statistics.rays = std::accumulate(num_rays_.begin(), num_rays_.end(), uint64_t{0});
        statistics.occluded =
            std::accumulate(num_occluded_.begin(), num_occluded_.end(), uint64_t{0});
        for (size_t v = 0; v < topology_.num_vertices; ++v) {
            statistics.zero_normals += has_normal(v) ? 0 : 1;
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
    const Topology& topology_;
    const Pose& pose_;
    const uint32_t p_;
    const Albedo& albedo_;
    const StillMesh& still_mesh_;
    const RayScene scene_;
    const RayStarts starts_;
    const std::vector<double> lobe_;  // [C]
    // [planes][V] the estimates of both halves; of one channel until bounced light is added
    std::array<std::vector<float>, 2> halves_;
    std::vector<uint64_t> num_rays_;      // [V]
    std::vector<uint64_t> num_occluded_;  // [V]
    std::vector<uint8_t> num_batches_;    // [V] of rays
    uint64_t num_all_back_hits_ = 0;
    std::vector<double> noise_energy_;  // [V] Σ_i (half the difference of the halves)²
    uint32_t num_above_target_ = 0;
};

TransferBaker::TransferBaker(const BakeOptions& options, Albedo albedo, StillMesh still_mesh)
    : options_(options),
      albedo_(std::move(albedo)),
      still_mesh_(std::move(still_mesh)),
      batches_(make_batches(options)),
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
