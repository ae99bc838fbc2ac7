// Whether bakes of few rays are off from one of many rays by more than chance.
#include "tests/analytic/bias.h"

#include <cmath>

#include "analysis/study/baked_matrices.h"

namespace paim {

using Eigen::Index;
using study::BakedMatrices;

namespace {

BakedMatrices bake(const PoseSource& source, SamplerKind sampler, uint32_t rays, uint64_t seed) {
    BakeOptions options;
    options.rays = rays;
    options.seed = seed;
    options.sampler = sampler;
    return study::bake_matrices(source, options, 1);
}

}  // namespace

double largest_z(const PoseSource& source, SamplerKind sampler, uint32_t rays, int num_seeds) {
    const BakedMatrices reference = bake(source, SamplerKind::cosine, kReferenceRays, 1000);
    const auto num_vertices = static_cast<Index>(source.topology().num_vertices);
    const Index num_coefficients = reference.transfer.rows() / num_vertices;
    Eigen::ArrayXXd sums = Eigen::ArrayXXd::Zero(num_coefficients, 2);
    Eigen::ArrayXXd variances = sums;
    const auto add = [&](const BakedMatrices& baked, double times) {
        for (Index i = 0; i < num_coefficients; ++i) {
            const auto values = [&](const Eigen::MatrixXf& matrix) {
                const auto rows = matrix.col(0).segment(i * num_vertices, num_vertices);
                return Eigen::ArrayXd(rows.cast<double>().array());
            };
            const Eigen::ArrayXd weight = values(reference.transfer);
            const Eigen::ArrayXd difference = values(baked.transfer) - weight;
            const Eigen::ArrayXd noise = values(baked.noise);
            sums(i, 0) += difference.sum();
            sums(i, 1) += (difference * weight).sum();
            variances(i, 0) += times * noise.square().sum();
            variances(i, 1) += times * (noise * weight).square().sum();
        }
    };
    for (int seed = 1; seed <= num_seeds; ++seed) {
        add(bake(source, sampler, rays, static_cast<uint64_t>(seed)), 1.0);
    }
    // It differs from itself by nothing, but its noise is in every seed's difference alike.
    add(reference, static_cast<double>(num_seeds) * num_seeds);
    return (sums / variances.sqrt()).abs().maxCoeff();
}

}  // namespace paim
