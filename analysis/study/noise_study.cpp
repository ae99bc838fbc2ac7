// The effect of encoding on the noise of a bake.
// Based on: Gavish and Donoho, Optimal Shrinkage of Singular Values, 2017
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>

#include "analysis/study/baked_matrices.h"
#include "analysis/study/studies.h"
#include "compressor/encode/encode.h"
#include "compressor/encode/noise/component_noise.h"
#include "compressor/encode/noise/rank_selection.h"
#include "compressor/encode/noise/shrinkage.h"
#include "compressor/encode/svd/principal_components.h"
#include "paim/metrics/pose_space.h"
#include "paim/metrics/transfer_error.h"

namespace paim::study {

namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::MatrixXf;
using Eigen::VectorXd;

// One bake, decomposed.
struct Case {
    const StudyOptions& options;
    const Truth& truth;
    const BakedMatrices& baked;
    const TransferLayout& layout;
    std::string label;  // rays and streams
    VectorXd mean;
    MatrixXd factors;  // [rows][K] A'V
    MatrixXd v;        // [P][K]
    VectorXd singular_values;
};

// The error to the truth that is expected from the bake alone, relative to the truth like the
// errors of Truth.
double expected_error(const Case& c, Index num_components, const MatrixXf& approximation) {
    const Index poses = c.v.rows();
    const Index vertices = approximation.rows() / static_cast<Index>(c.layout.num_planes());
    const MatrixXf weights = c.v.leftCols(num_components).cast<float>();
    const MatrixXd span = orthonormal_pose_space(
        {weights.data(), static_cast<size_t>(weights.size())}, static_cast<uint32_t>(poses));
    TransferErrorMeter meter(c.layout, static_cast<uint32_t>(vertices),
                             static_cast<uint32_t>(poses), BandPower::flat(c.layout.in_bands),
                             span);
    const auto plane_of = [&](const MatrixXf& matrix, uint32_t plane) {
        return matrix.middleRows(static_cast<Index>(plane) * vertices, vertices);
    };
    for (uint32_t plane = 0; plane < c.layout.num_planes(); ++plane) {
        meter.survey(plane, plane_of(c.baked.transfer, plane), plane_of(c.baked.noise, plane));
    }
    for (uint32_t plane = 0; plane < c.layout.num_planes(); ++plane) {
        meter.add(plane, plane_of(c.baked.transfer, plane), plane_of(c.baked.noise, plane),
                  plane_of(approximation, plane));
    }
    const TransferError result = meter.result();
    return result.error / std::sqrt(1.0 - result.bake_noise * result.bake_noise);
}

void print(const Case& c, const char* method, Index num_components, const MatrixXf& approximation) {
    const double flicker = c.truth.flicker(approximation);
    fmt::print("{},{},{},{},{:.5f},{:.5f},{}\n", c.options.name, c.label, method, num_components,
               c.truth.error(approximation), expected_error(c, num_components, approximation),
               std::isfinite(flicker) ? fmt::format("{:.4f}", flicker) : "");
    std::fflush(stdout);
}

// Mean and the first K components, each multiplied by a factor.
MatrixXf rebuild(const Case& c, const VectorXd& factors, Index num_components) {
    const MatrixXd kept =
        c.factors.leftCols(num_components) * factors.head(num_components).asDiagonal();
    return ((kept * c.v.leftCols(num_components).transpose()).colwise() + c.mean).cast<float>();
}

MatrixXf rebuild_shrunk(const Case& c, const Shrinkage& shrinkage, Index num_components) {
    std::vector<std::vector<float>> factors(static_cast<size_t>(num_components));
    MatrixXd kept(c.factors.rows(), num_components);
    for (Index k = 0; k < num_components; ++k) {
        const Eigen::VectorXf column = c.factors.col(k).cast<float>();
        factors[static_cast<size_t>(k)].assign(column.begin(), column.end());
    }
    shrinkage.apply(0, factors);
    for (Index k = 0; k < num_components; ++k) {
        const auto& column = factors[static_cast<size_t>(k)];
        kept.col(k) = Eigen::Map<const Eigen::VectorXf>(column.data(), kept.rows()).cast<double>();
    }
    return ((kept * c.v.leftCols(num_components).transpose()).colwise() + c.mean).cast<float>();
}

// Gavish and Donoho's factors for squared error and white noise of the measured energy: with y the
// singular value in units of √columns-worth of noise and β the aspect ratio,
// √((y² − β − 1)² − 4β) / y².
VectorXd gavish_donoho(const Case& c, const ComponentNoise& noise) {
    const double white = noise.noise.sum() / static_cast<double>(noise.noise.cols());
    const double beta = static_cast<double>(c.v.rows()) / static_cast<double>(c.factors.rows());
    return c.singular_values.unaryExpr([&](double s) {
        const double y2 = white > 0.0 ? s * s / white : 0.0;
        if (white <= 0.0) return 1.0;
        if (y2 <= std::pow(1.0 + std::sqrt(beta), 2)) return 0.0;
        return std::sqrt(std::max(0.0, std::pow(y2 - beta - 1.0, 2) - 4.0 * beta)) / y2;
    });
}

void study_bake(const BakedMatrices& baked, const TransferLayout& layout,
                const StudyOptions& options, const Truth& truth, std::string label) {
    const MatrixRows transfer(baked.transfer);
    const MatrixRows noise_rows(baked.noise);
    const PrincipalComponents components = principal_components(transfer);
    const ComponentNoise noise = measure_component_noise(transfer, noise_rows, layout, components);
    const Shrinkage shrinkage(noise);
    const auto rank = static_cast<Index>(components.rank());
    Case c{options, truth, baked, layout, std::move(label), {}, {}, components.v.leftCols(rank),
           {}};
    const MatrixXd values = baked.transfer.cast<double>();
    c.mean = values.rowwise().mean();
    c.factors = (values.colwise() - c.mean) * c.v;
    c.singular_values = Eigen::Map<const VectorXd>(components.singular_values.data(), rank);

    print(c, "bake", rank, baked.transfer);
    VectorXd wiener(rank);
    for (Index k = 0; k < rank; ++k) {
        wiener[k] = noise.signal_of(k) / noise.energy.col(k).sum();
    }
    const VectorXd optimal = gavish_donoho(c, noise);
    std::vector<Index> counts{5, 8, 12, 16, 20, 30, 40, rank};
    for (const Index k : counts) {
        if (k > rank) continue;
        print(c, "truncate", k, rebuild(c, VectorXd::Ones(rank), k));
        print(c, "gavish-donoho", k, rebuild(c, optimal, k));
        print(c, "wiener", k, rebuild(c, wiener, k));
        print(c, "wiener by vertex and band", k, rebuild_shrunk(c, shrinkage, k));
    }
    const auto automatic = static_cast<Index>(choose_components({}, noise, 0.01));
    print(c, "auto", automatic, rebuild_shrunk(c, shrinkage, automatic));
    const EncodedError expected = shrinkage.expected_error(static_cast<uint32_t>(automatic));
    const double energy = values.squaredNorm() - baked.noise.cast<double>().squaredNorm();
    fmt::print("{},{},auto (as it estimates itself),{},{:.5f},,\n", options.name, c.label,
               automatic, std::sqrt(expected.total() / energy));
}

}  // namespace

void study_noise(const PoseSource& source, const StudyOptions& options) {
    BakeOptions bake;
    bake.bands = options.bands;
    bake.rays = options.truth_rays;
    bake.seed = 77;
    const Truth truth(bake_matrices(source, bake, options.num_poses));
    const TransferLayout layout{TransferKind::diffuse, options.bands, 1};
    bake.seed = 1;
    fmt::print("sequence,rays,streams,method,components,true_error,expected_error,flicker\n");
    for (const uint32_t rays : options.rays) {
        for (const Streams streams : {Streams::per_pose, Streams::shared, Streams::mixed}) {
            bake.rays = rays;
            bake.streams = streams;
            study_bake(bake_matrices(source, bake, options.num_poses), layout, options, truth,
                       fmt::format("{},{}", rays, streams_name(streams)));
        }
    }
}

}  // namespace paim::study
