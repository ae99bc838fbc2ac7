// Encoding against Eigen's divide-and-conquer SVD of the same centred matrix.
#include <Eigen/SVD>

#include <random>

#include "analysis/bench/ratio.h"
#include "compressor/encode/svd/projected_blocks.h"
#include "paim/base/check.h"

namespace paim::bench {

namespace {

// Rank 20, falling off as animations do, under noise of a thousandth.
Eigen::MatrixXf animation_like(Eigen::Index num_rows, Eigen::Index num_columns) {
    std::mt19937 engine(5);
    std::normal_distribution<float> normal;
    const auto draw = [&] { return normal(engine); };
    constexpr Eigen::Index kRank = 20;
    const Eigen::MatrixXf shapes = Eigen::MatrixXf::NullaryExpr(num_rows, kRank, draw);
    Eigen::MatrixXf weights = Eigen::MatrixXf::NullaryExpr(kRank, num_columns, draw);
    for (Eigen::Index k = 0; k < kRank; ++k)
        weights.row(k) *= std::pow(0.7f, static_cast<float>(k));
    return shapes * weights + 1e-3f * Eigen::MatrixXf::NullaryExpr(num_rows, num_columns, draw);
}

void encode(benchmark::State& state, Eigen::Index num_rows, Eigen::Index num_columns) {
    const Eigen::MatrixXf matrix = animation_like(num_rows, num_columns);
    const MatrixRows rows(matrix);
    Eigen::VectorXd reference_values;
    PrincipalComponents components;
    double factor_cpu_s = 0.0;
    run_against(
        state,
        [&] {
            Eigen::MatrixXd centred = matrix.cast<double>();
            const Eigen::VectorXd mean = centred.rowwise().mean();
            centred.colwise() -= mean;
            const Eigen::BDCSVD<Eigen::MatrixXd> reference(
                centred, Eigen::ComputeThinU | Eigen::ComputeThinV);
            reference_values = reference.singularValues();
        },
        [&] {
            factor_cpu_s = timed([&] { components = principal_components(rows); }).cpu_s;
            uint64_t num_seen = 0;
            for_each_encoded_block(rows, components, components.rank(),
                                   [&](const EncodedRows& block) {
                                       num_seen += block.mean.size();
                                       benchmark::DoNotOptimize(block.components.data());
                                   });
            PAIM_CHECK_EQ(num_seen, rows.num_rows());
        });
    // Otherwise it was not the same work.
    for (Eigen::Index k = 0; k < num_columns; ++k) {
        const double difference =
            components.singular_values[static_cast<size_t>(k)] - reference_values[k];
        PAIM_CHECK_LE(std::abs(difference), 1e-10 * reference_values[0]);
    }
    state.counters["factor_cpu_s"] = factor_cpu_s;
}

BENCHMARK_CAPTURE(encode, small, 5000, 20)->UseManualTime()->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(encode, rows_100000_poses_100, 100000, 100)
    ->UseManualTime()
    ->Iterations(3)
    ->Unit(benchmark::kMillisecond);

}  // namespace

}  // namespace paim::bench
