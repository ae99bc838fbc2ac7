// How small and how fast clustered principal components are: the table of docs/equations.md.
//   paim-cluster-study X.bake [--curves] [CLUSTERSxCOMPONENTS]...
//   paim-cluster-study --synthetic VxPLANESxCOLUMNS [CLUSTERSxCOMPONENTS]...
#include <fmt/format.h>

#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "analysis/bench/synthetic_points.h"
#include "compressor/encode/bake_rows.h"
#include "compressor/encode/clustered_pca.h"
#include "compressor/encode/clustering.h"
#include "compressor/encode/point_projection.h"
#include "paim/base/error.h"

namespace paim {
namespace {

using Shape = std::pair<uint32_t, uint32_t>;  // clusters, components

double sum_of_squares(const PointSource& points) {
    Eigen::MatrixXf plane(points.num_points(), points.num_columns());
    double sum = 0.0;
    for (uint32_t j = 0; j < points.num_planes(); ++j) {
        points.read(j, plane);
        sum += plane.cast<double>().squaredNorm();
    }
    return sum;
}

template <typename Body>
double seconds(Body&& body) {
    const auto start = std::chrono::steady_clock::now();
    body();
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

void measure(const PointSource& points, Shape shape, double total, bool curve) {
    ClusteringOptions options;
    options.num_clusters = shape.first;
    options.assumed_components = options.max_components = shape.second;
    options.memory_bytes = 4'000'000'000;
    ClusteredPca pca;
    Eigen::MatrixXf projected;
    Clustering clustering;
    const double projecting_s =
        seconds([&] { projected = project_points(points, options.num_dimensions(), options.seed); });
    const double clustering_s = seconds([&] { clustering = cluster_points(projected, options); });
    const double whole_s = seconds([&] { pca = clustered_pca(points, options); });
    fmt::print("{}x{}: error {:.5f}, {:.2f} s ({:.2f} s projecting, {:.2f} s clustering), {} MB\n",
               shape.first, shape.second, std::sqrt(pca.squared_error(pca.num_components) / total),
               whole_s, projecting_s, clustering_s,
               clustered_pca_memory_bytes(points, options) / 1'000'000);
    for (uint32_t k = 0; curve && k <= pca.num_components; ++k) {
        fmt::print("{}{:.5f}", k == 0 ? "    " : " ", std::sqrt(pca.squared_error(k) / total));
    }
    if (curve) fmt::print("\n");
    std::fflush(stdout);
}

std::vector<uint32_t> numbers(const std::string& text, size_t count) {
    std::vector<uint32_t> values;
    for (size_t at = 0; at <= text.size(); at = std::min(text.find('x', at), text.size()) + 1) {
        values.push_back(static_cast<uint32_t>(std::strtoul(text.c_str() + at, nullptr, 10)));
    }
    if (values.size() != count) throw_usage("{}: expected {} numbers with x between", text, count);
    return values;
}

void run(int argc, char** argv) {
    if (argc < 2) throw_usage("expected X.bake or --synthetic VxPLANESxCOLUMNS");
    const bool synthetic = std::strcmp(argv[1], "--synthetic") == 0 && argc > 2;
    int at = synthetic ? 3 : 2;
    const bool curve = at < argc && std::strcmp(argv[at], "--curves") == 0;
    at += curve ? 1 : 0;
    std::vector<Shape> shapes;
    for (; at < argc; ++at) {
        const auto shape = numbers(argv[at], 2);
        shapes.emplace_back(shape[0], shape[1]);
    }
    if (shapes.empty()) shapes = {{64, 24}, {256, 8}, {256, 12}, {512, 8}, {1024, 6}};
    std::unique_ptr<BakeReader> bake;
    std::unique_ptr<RowSource> rows;
    std::unique_ptr<PointSource> points;
    if (synthetic) {
        const auto size = numbers(argv[2], 3);
        points = std::make_unique<bench::SyntheticPoints>(size[0], size[1], size[2]);
    } else {
        bake = std::make_unique<BakeReader>(argv[1]);
        const TransferLayout& layout = bake->identity().layout;
        rows = std::make_unique<TransferRows>(*bake, layout.bands);
        points = std::make_unique<RowPlanes>(*rows, static_cast<uint32_t>(layout.num_planes()));
    }
    const double total = sum_of_squares(*points);
    fmt::print("{} points, {} planes of {}\n", points->num_points(), points->num_planes(),
               points->num_columns());
    for (const Shape& shape : shapes) measure(*points, shape, total, curve);
}

}  // namespace
}  // namespace paim

int main(int argc, char** argv) {
    try {
        paim::run(argc, argv);
        return 0;
    } catch (const paim::Error& error) {
        fmt::print(stderr, "{}\n", error.what());
        return static_cast<int>(error.code());
    }
}
