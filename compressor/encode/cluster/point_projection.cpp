// A randomised principal component analysis that keeps the points' coordinates.
// Based on: Halko, Martinsson and Tropp 2011 (see the header), algorithms 4.1 and 5.1
#include "compressor/encode/cluster/point_projection.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "compressor/encode/cluster/top_eigenpairs.h"
#include "paim/base/parallel.h"
#include "paim/base/seed.h"

namespace paim {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::MatrixXf;

namespace {

constexpr Index kBlock = 1024;    // points whose products are summed in float before double
constexpr Index kGramParts = 16;  // partial sums of a Gram matrix

Index num_blocks(Index num_points) {
    return (num_points + kBlock - 1) / kBlock;
}

// Calls body(first, count) for the blocks of the points, on all threads.
template <typename Body>
void for_blocks(Index num_points, Body&& body) {
    parallel_for(static_cast<size_t>(num_blocks(num_points)), 1, [&](size_t b, size_t) {
        const Index first = static_cast<Index>(b) * kBlock;
        body(first, std::min(kBlock, num_points - first));
    });
}

// Subtracts the mean over the points from each column, so that rounding is relative to what
// differs.
void centre_columns(MatrixXf& plane) {
    parallel_for(static_cast<size_t>(plane.cols()), 8, [&](size_t begin, size_t end) {
        for (auto c = static_cast<Index>(begin); c < static_cast<Index>(end); ++c) {
            const double mean = plane.col(c).cast<double>().mean();
            plane.col(c) = (plane.col(c).cast<double>().array() - mean).cast<float>();
        }
    });
}

// Signs of one plane's rows of the projection: [n][l]. Achlioptas, Database-friendly Random
// Projections, 2003: as good as normal variables.
MatrixXf random_signs(uint32_t plane, uint32_t num_columns, Index num_sketch, uint64_t seed) {
    MatrixXf signs(static_cast<Index>(num_columns), num_sketch);
    RandomStream random(stream_key(seed, plane, num_columns));
    const float size = 1.0f / std::sqrt(static_cast<float>(num_sketch));
    for (Index k = 0; k < signs.size(); ++k) {
        signs.data()[k] = random.next_u64() >> 63 ? size : -size;
    }
    return signs;
}

// The Gram matrix of rows, S Sᵀ of S [l][V], summed by blocks in a fixed order.
MatrixXd row_gram(const MatrixXf& sketch) {
    const Index size = sketch.rows();
    // The same number of partial sums on any number of threads.
    const Index parts = std::min(kGramParts, num_blocks(sketch.cols()));
    std::vector<MatrixXd> sums(static_cast<size_t>(parts), MatrixXd::Zero(size, size));
    parallel_for(static_cast<size_t>(parts), 1, [&](size_t part, size_t) {
        MatrixXf product(size, size);
        for (auto b = static_cast<Index>(part); b < num_blocks(sketch.cols()); b += parts) {
            const Index count = std::min(kBlock, sketch.cols() - b * kBlock);
            const auto block = sketch.middleCols(b * kBlock, count);
            product.setZero();
            product.selfadjointView<Eigen::Lower>().rankUpdate(block);
            sums[part] += product.cast<double>();
        }
    });
    for (size_t part = 1; part < sums.size(); ++part) sums[0] += sums[part];
    return sums.empty() ? MatrixXd::Zero(size, size) : sums[0];
}

// sketch ← map · sketch, block by block in place; map [m][l], m <= l. Rows from m on are left over.
void map_columns(const MatrixXd& map, MatrixXf& sketch) {
    const MatrixXf map_f = map.cast<float>();
    for_blocks(sketch.cols(), [&](Index first, Index count) {
        const MatrixXf mapped = map_f * sketch.middleCols(first, count);
        sketch.middleCols(first, count).topRows(map.rows()) = mapped;
    });
}

// Eigenvectors as rows, the largest first, of those above the rounding of floats.
struct Directions {
    MatrixXd rows;           // [m][l]
    Eigen::VectorXd values;  // [m]
};

Directions principal_directions(const MatrixXd& gram, Index at_most) {
    const Eigenpairs all = all_eigenpairs(gram);
    const Index most = std::min(at_most, all.values.size());
    // Sums of floats are right to some 2^-23; below that there are no directions, only rounding.
    const double floor = most == 0 ? 0.0 : 0x1p-22 * std::max(0.0, all.values[0]);
    Index kept = 0;
    while (kept < most && all.values[kept] > floor) ++kept;
    return {all.vectors.leftCols(kept).transpose(), all.values.head(kept)};
}

}  // namespace

uint64_t sketch_columns(uint64_t num_dimensions, uint64_t of) {
    return std::min(of, num_dimensions + num_dimensions / 4 + 8);
}

uint64_t projection_scratch_bytes(const PointSource& points, uint64_t num_dimensions,
                                  uint64_t num_threads) {
    const uint64_t num_points = points.num_points(), columns = points.num_columns();
    const uint64_t sketch = sketch_columns(num_dimensions, points.num_dimensions());
    // The parts, their sum, its eigenvectors with their work space, and the map that they make.
    const uint64_t grams = uint64_t{kGramParts} + 4;
    return sizeof(float) *
               (num_points * (columns + 2 * sketch) + num_threads * uint64_t{kBlock} * sketch) +
           sizeof(double) * (grams * sketch * sketch + (sketch + 2 * columns) * columns);
}

MatrixXf project_points(const PointSource& points, uint32_t num_dimensions, uint64_t seed) {
    const auto num_points = static_cast<Index>(points.num_points());
    const auto num_sketch =
        static_cast<Index>(sketch_columns(num_dimensions, points.num_dimensions()));
    const bool whole = static_cast<uint64_t>(num_sketch) == points.num_dimensions();
    MatrixXf plane(num_points, static_cast<Index>(points.num_columns()));
    MatrixXf sketch = MatrixXf::Zero(num_sketch, num_points);
    for (uint32_t j = 0; j < points.num_planes(); ++j) {
        points.read(j, plane);
        centre_columns(plane);
        const MatrixXf signs =
            whole ? MatrixXf() : random_signs(j, points.num_columns(), num_sketch, seed);
        for_blocks(num_points, [&](Index first, Index count) {
            const auto block = plane.middleRows(first, count).transpose();
            auto sums = sketch.middleCols(first, count);
            if (whole) {
                sums.middleRows(static_cast<Index>(j) * plane.cols(), plane.cols()) = block;
            } else {
                sums.noalias() += signs.transpose() * block;
            }
        });
    }
    Directions directions = principal_directions(row_gram(sketch), num_sketch);
    if (!whole) {
        // Orthonormal rows Q [m][V] that span the sketch; then B = Q X, plane by plane, and the
        // principal coordinates U S of Q B are Fᵀ S of B Bᵀ = F S² Fᵀ.
        const MatrixXd to_orthonormal =
            directions.values.cwiseSqrt().cwiseInverse().asDiagonal() * directions.rows;
        map_columns(to_orthonormal, sketch);
        const auto q = sketch.topRows(to_orthonormal.rows());
        MatrixXd gram = MatrixXd::Zero(q.rows(), q.rows());
        for (uint32_t j = 0; j < points.num_planes(); ++j) {
            points.read(j, plane);
            centre_columns(plane);
            MatrixXf b(q.rows(), plane.cols());
            constexpr size_t kColumns = 16;
            parallel_for(
                static_cast<size_t>(plane.cols()), kColumns, [&](size_t begin, size_t end) {
                    const auto first = static_cast<Index>(begin);
                    const auto count = static_cast<Index>(end - begin);
                    b.middleCols(first, count).noalias() = q * plane.middleCols(first, count);
                });
            gram.selfadjointView<Eigen::Lower>().rankUpdate(b.cast<double>());
        }
        directions = principal_directions(gram, num_dimensions);
        directions.rows = directions.values.cwiseSqrt().asDiagonal() * directions.rows;
        MatrixXf narrower = q;
        sketch.swap(narrower);
    }
    const Index kept = std::min<Index>(directions.rows.rows(), num_dimensions);
    map_columns(directions.rows.topRows(kept), sketch);
    return sketch.topRows(kept);
}

}  // namespace paim
