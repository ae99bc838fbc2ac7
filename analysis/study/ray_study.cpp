// Error against the number of rays: for each sampler, and with noise targets.
#include <fmt/format.h>

#include <cmath>

#include "analysis/study/baked_matrices.h"
#include "analysis/study/studies.h"

namespace paim::study {

namespace {

double rays_per_vertex(const PoseSource& source, const StudyOptions& options,
                       const BakedMatrices& baked) {
    return static_cast<double>(baked.num_rays) /
           (static_cast<double>(source.topology().num_vertices) * options.num_poses);
}

Truth bake_truth(const PoseSource& source, const StudyOptions& options) {
    BakeOptions bake;
    bake.bands = options.bands;
    bake.rays = options.truth_rays;
    bake.seed = 77;
    return Truth(bake_matrices(source, bake, options.num_poses));
}

double error_estimate(const BakedMatrices& baked) {
    return std::sqrt(baked.noise.cast<double>().squaredNorm() /
                     baked.transfer.cast<double>().squaredNorm());
}

}  // namespace

void study_samplers(const PoseSource& source, const StudyOptions& options) {
    const Truth truth = bake_truth(source, options);
    fmt::print("sequence,sampler,rays,rays_traced_per_vertex,true_error,estimated_error\n");
    for (const SamplerKind sampler :
         {SamplerKind::cosine, SamplerKind::uniform_sobol, SamplerKind::uniform}) {
        for (const uint32_t rays : options.rays) {
            BakeOptions bake;
            bake.bands = options.bands;
            bake.sampler = sampler;
            bake.rays = rays;
            const BakedMatrices baked = bake_matrices(source, bake, options.num_poses);
            fmt::print("{},{},{},{:.1f},{:.6f},{:.6f}\n", options.name, sampler_name(sampler), rays,
                       rays_per_vertex(source, options, baked), truth.error(baked.transfer),
                       error_estimate(baked));
            std::fflush(stdout);
        }
    }
}

void study_targets(const PoseSource& source, const StudyOptions& options) {
    const Truth truth = bake_truth(source, options);
    fmt::print(
        "sequence,target,rays_at_most,rays_traced_per_vertex,true_error,estimated_error,"
        "worst_vertex_in_1000\n");
    const auto measure = [&](const BakeOptions& bake) {
        const BakedMatrices baked = bake_matrices(source, bake, options.num_poses);
        fmt::print("{},{},{},{:.1f},{:.6f},{:.6f},{:.6f}\n", options.name, bake.transfer_error,
                   bake.rays, rays_per_vertex(source, options, baked), truth.error(baked.transfer),
                   error_estimate(baked),
                   truth.vertex_error(baked.transfer, source.topology().num_vertices, 0.999) /
                       open_transfer_norm(options.bands));
        std::fflush(stdout);
    };
    BakeOptions bake;
    bake.bands = options.bands;
    for (const uint32_t rays : options.rays) {
        bake.rays = rays;
        measure(bake);
    }
    bake.rays = options.truth_rays;
    for (const double target : options.targets) {
        bake.transfer_error = target;
        measure(bake);
    }
}

}  // namespace paim::study
