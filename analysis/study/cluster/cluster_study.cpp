// paim-cluster-study: sizes and times of clustered principal components, the tables of
// docs/results/clusters.md.
//   paim-cluster-study X.bake|VxPLANESxCOLUMNS [--curves] [--rounds MEANxAFFINE] [--projection D]
//                      [--seed S] [CLUSTERSxCOMPONENTS[xASSUMED]]...
// With a size in place of a bake, the points are synthetic.
#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <memory>
#include <string>
#include <vector>

#include "analysis/bench/cluster/synthetic_points.h"
#include "compressor/encode/cluster/clustered_pca.h"
#include "compressor/encode/cluster/clustering.h"
#include "compressor/encode/cluster/point_projection.h"
#include "compressor/encode/data/bake_rows.h"
#include "paim/base/error.h"
#include "paim/base/tbb_parallel.h"

namespace paim {
namespace {

double sum_of_squares(const PointSource& points) {
    Eigen::MatrixXf plane(points.num_points(), points.num_columns());
    double sum = 0.0;
    for (uint32_t j = 0; j < points.num_planes(); ++j) {
        points.read(j, plane);
        sum += plane.cast<double>().squaredNorm();
    }
    return sum;
}

struct Times {
    double wall_s = 0.0;
    double cpu_s = 0.0;  // of all threads, which a busy machine disturbs least
};

template <typename Body>
Times timed(Body&& body) {
    const auto start = std::chrono::steady_clock::now();
    const std::clock_t cpu = std::clock();
    body();
    return {std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count(),
            static_cast<double>(std::clock() - cpu) / CLOCKS_PER_SEC};
}

void measure(const PointSource& points, const ClusteringOptions& options, double total,
             bool curve) {
    ClusteredPca pca;
    Eigen::MatrixXf projected;
    Clustering clustering;
    const Times projecting =
        timed([&] { projected = project_points(points, options.num_dimensions(), options.seed); });
    const Times cutting = timed([&] { clustering = cluster_points(projected, options); });
    const Times whole = timed([&] { pca = clustered_pca(points, options); });
    fmt::print(
        "{}x{}: error {:.5f}, {:.2f} s, of processor {:.2f} s ({:.2f} s "
        "projecting, {:.2f} s clustering), {} MB\n",
        options.num_clusters, options.max_components,
        std::sqrt(pca.squared_error(pca.num_components) / total), whole.wall_s, whole.cpu_s,
        projecting.cpu_s, cutting.cpu_s, clustered_pca_memory_bytes(points, options) / 1'000'000);
    for (uint32_t k = 0; curve && k <= pca.num_components; ++k) {
        fmt::print("{}{:.5f}", k == 0 ? "    " : " ", std::sqrt(pca.squared_error(k) / total));
    }
    if (curve) fmt::print("\n");
    std::fflush(stdout);
}

// Numbers separated by x; empty if the text is anything else.
std::vector<uint32_t> numbers(const std::string& text) {
    std::vector<uint32_t> values;
    if (text.empty() || text.find_first_not_of("0123456789x") != std::string::npos) return values;
    for (size_t at = 0; at <= text.size(); at = std::min(text.find('x', at), text.size()) + 1) {
        values.push_back(static_cast<uint32_t>(std::strtoul(text.c_str() + at, nullptr, 10)));
    }
    return values;
}

struct Study {
    std::vector<ClusteringOptions> runs;
    bool curves = false;
};

Study parse(const std::vector<std::string>& words) {
    Study study;
    ClusteringOptions options;
    options.memory_bytes = 4'000'000'000;
    std::vector<std::vector<uint32_t>> shapes;
    for (size_t at = 0; at < words.size(); ++at) {
        const std::string& word = words[at];
        if (word == "--curves") {
            study.curves = true;
            continue;
        }
        const bool option = word.starts_with("--");
        const auto values = numbers(option && at + 1 < words.size() ? words[++at] : word);
        if (word == "--rounds" && values.size() == 2) {
            options.mean_rounds = values[0];
            options.affine_rounds = values[1];
        } else if (word == "--projection" && values.size() == 1) {
            options.projection = values[0];
        } else if (word == "--seed" && values.size() == 1) {
            options.seed = values[0];
        } else if (!option && (values.size() == 2 || values.size() == 3)) {
            shapes.push_back(values);
        } else {
            throw_usage("{}: expected CLUSTERSxCOMPONENTS or an option and its numbers", word);
        }
    }
    if (shapes.empty()) shapes = {{64, 24}, {256, 8}, {256, 12}, {512, 8}, {1024, 6}};
    for (const auto& shape : shapes) {
        options.num_clusters = shape[0];
        options.max_components = shape[1];
        options.assumed_components = shape.back();
        study.runs.push_back(options);
    }
    return study;
}

void run(const std::vector<std::string>& words) {
    if (words.empty()) throw_usage("expected X.bake or VxPLANESxCOLUMNS");
    const Study study = parse({words.begin() + 1, words.end()});
    const std::vector<uint32_t> size = numbers(words[0]);
    std::unique_ptr<BakeReader> bake;
    std::unique_ptr<RowSource> rows;
    std::unique_ptr<PointSource> points;
    if (size.size() == 3) {
        points = std::make_unique<bench::SyntheticPoints>(size[0], size[1], size[2]);
    } else {
        bake = std::make_unique<BakeReader>(words[0]);
        const TransferLayout& layout = bake->identity().layout;
        rows = std::make_unique<TransferRows>(*bake, layout.in_bands);
        points = std::make_unique<RowPlanes>(*rows, static_cast<uint32_t>(layout.num_planes()));
    }
    const double total = sum_of_squares(*points);
    fmt::print("{} points, {} planes of {}\n", points->num_points(), points->num_planes(),
               points->num_columns());
    for (const ClusteringOptions& options : study.runs) {
        measure(*points, options, total, study.curves);
    }
}

}  // namespace
}  // namespace paim

int main(int argc, char** argv) {
    paim::use_tbb();
    try {
        paim::run({argv + 1, argv + argc});
        return 0;
    } catch (const paim::Error& error) {
        fmt::print(stderr, "{}\n", error.what());
        return static_cast<int>(error.code());
    }
}
