// paim-thesis-study: clusters of the glossy transfer of one pose, and how often triangles are drawn if
// the bases of clusters must fit into registers: the tables of docs/results/thesis_table.md.
// Based on: Chen, thesis on clustered principal components for glossy precomputed radiance transfer,
//           2005; Sloan, Hall, Hart and Snyder, Clustered Principal Components for Precomputed
//           Radiance Transfer, 2003
#include <fmt/format.h>

#include <CLI/CLI.hpp>

#include <algorithm>
#include <cstdio>
#include <ctime>
#include <memory>
#include <string>
#include <vector>

#include "analysis/study/cluster/hyper_boxes.h"
#include "analysis/study/cluster/overdraw.h"
#include "analysis/study/gloss/frame_transfer.h"
#include "analysis/study/open_source.h"
#include "compressor/bake/bake_options.h"
#include "compressor/encode/cluster/clustered_pca.h"
#include "compressor/encode/cluster/point_projection.h"
#include "compressor/material/brdfs.h"
#include "paim/cli/parse.h"
#include "paim/cli/run_main.h"
#include "paim/mesh/tangent_frames.h"

namespace {

using namespace paim;
using namespace paim::study;
using Eigen::Index;

struct Options {
    std::string name;
    uint32_t in_bands = 5, out_bands = 4, rays = 1024, components = 8, registers = 256;
    std::vector<uint32_t> clusters{64, 128, 192, 256};
    std::vector<std::string> brdfs{"phong:0.5,32", "cook-torrance:0.5,0.4"};
    double alpha = 0.05;
};

// Processor time of all threads, which a busy machine disturbs least.
class Clock {
  public:
    double seconds() const { return static_cast<double>(std::clock() - start_) / CLOCKS_PER_SEC; }

  private:
    std::clock_t start_ = std::clock();
};

// The orthonormal directions of clusters in full dimension.
class Bases {
  public:
    Bases(const PointSource& source, const Eigen::MatrixXf& points, const ClusteredPca& pca)
        : points_(points), step_(static_cast<Index>(pca.num_components) + 1) {
        for_each_basis_plane(source, pca, pca.num_components,
                             [&](uint32_t, const Eigen::MatrixXf& rows) { rows_ = rows; });
        for (Index r = 0; r < rows_.rows(); ++r) {
            const float norm = rows_.row(r).norm();
            if (r % step_ != 0 && norm > 0.0f) rows_.row(r) /= norm;
        }
    }

    double squared_error(uint32_t v, uint32_t c) const {
        const Index first = static_cast<Index>(c) * step_;
        const Eigen::VectorXd x =
            (points_.row(static_cast<Index>(v)) - rows_.row(first)).transpose().cast<double>();
        const Eigen::VectorXd along = rows_.middleRows(first + 1, step_ - 1).cast<double>() * x;
        return std::max(0.0, x.squaredNorm() - along.squaredNorm());
    }

  private:
    const Eigen::MatrixXf& points_;  // [V][D]
    Index step_;
    Eigen::MatrixXf rows_;  // [clusters (K + 1)][D]
};

class Study {
  public:
    Study(const Topology& topology, Eigen::MatrixXf points, const Options& options,
          std::string brdf)
        : topology_(topology),
          points_(std::move(points)),
          source_(points_, 1),
          options_(options),
          brdf_(std::move(brdf)),
          energy_(points_.cast<double>().squaredNorm()) {}

    // With one number of clusters, by both ways to begin.
    void measure(uint32_t num_clusters) const {
        ClusteringOptions options;
        options.num_clusters = num_clusters;
        options.assumed_components = options.max_components = options_.components;
        options.memory_bytes = 4'000'000'000;
        for (const bool boxes : {true, false}) {
            const Clock clock;
            const Eigen::MatrixXf projected =
                project_points(source_, options.num_dimensions(), options.seed);
            const Clustering clustering =
                boxes ? cluster_points_from(projected, hyper_box_means(projected, num_clusters),
                                            options)
                      : cluster_points(projected, options);
            const ClusteredPca pca = clustered_pca(source_, projected, clustering, options);
            const std::string begin = fmt::format("{},{},{},{}", options_.name, brdf_,
                                                  boxes ? "boxes" : "spread", pca.num_clusters);
            print(begin + ",plain", clock.seconds(), pca, 0);

            const Clock coherence;
            const Bases bases(source_, points_, pca);
            Clustering coherent = clustering;
            const uint32_t moves = make_coherent(
                topology_, [&](uint32_t v, uint32_t c) { return bases.squared_error(v, c); },
                options_.alpha, coherent.cluster);
            const ClusteredPca after = clustered_pca(source_, projected, coherent, options);
            print(begin + ",coherent", coherence.seconds(), after, moves);
        }
    }

  private:
    // Clusters whose bases fit into the registers, four values each.
    uint32_t most_clusters(uint32_t channels) const {
        const uint32_t values = channels * options_.out_bands * options_.out_bands;
        const uint32_t registers = (options_.components + 1) * ((values + 3) / 4);
        return std::max(1u, options_.registers / registers);
    }

    double merged_overdraw(const ClusteredPca& pca, uint32_t channels) const {
        const std::vector<uint32_t> group =
            super_clusters(topology_, pca.cluster, pca.num_clusters, most_clusters(channels));
        std::vector<uint32_t> of_vertex;
        for (const uint32_t c : pca.cluster) of_vertex.push_back(group[c]);
        return overdraw(topology_, of_vertex);
    }

    void print(const std::string& begin, double seconds, const ClusteredPca& pca,
               uint32_t moves) const {
        const double error = pca.squared_error(pca.num_components);
        fmt::print("{},{:.2f},{:.6g},{:.6f},{},{:.4f},{:.4f},{:.4f}\n", begin, seconds, error,
                   error / energy_, moves, overdraw(topology_, pca.cluster),
                   merged_overdraw(pca, 1), merged_overdraw(pca, 3));
        std::fflush(stdout);
    }

    const Topology& topology_;
    Eigen::MatrixXf points_;
    MatrixPoints source_;
    const Options& options_;
    std::string brdf_;
    double energy_;
};

void run_study(const PoseSource& source, const Options& options) {
    const Pose pose = source.load_pose(0);
    const auto frames =
        TangentFrames(source.topology(), pose.positions).at(pose.positions, pose.normals);
    fmt::print(
        "sequence,brdf,seeding,clusters,method,processor_s,squared_error,squared_error_of_all,"
        "moves,overdraw,overdraw_super_1_channel,overdraw_super_3_channels\n");
    for (const std::string& text : options.brdfs) {
        const auto brdf = parse_brdf(text);
        const ExitFunctions exit(*brdf, static_cast<int>(options.out_bands));
        FrameTransferOptions transfer;
        transfer.in_bands = options.in_bands;
        transfer.rays = options.rays;
        const Study study(
            source.topology(),
            in_pose_axes(frame_transfer(source.topology(), pose, frames, exit, transfer), frames,
                         exit),
            options, fmt::format("\"{}\"", text));
        for (const uint32_t clusters : options.clusters) study.measure(clusters);
    }
}

int run(int argc, char** argv) {
    CLI::App app(
        "Cuts the vertices of the first pose into clusters by their glossy transfer, and counts how\n"
        "often triangles are drawn if a draw has the bases of few clusters alone. CSV on stdout:\n"
        "  seeding   boxes: means of hyper-boxes; spread: points far from each other (k-means++)\n"
        "  method    plain, or coherent: vertices move to clusters of their neighbours\n"
        "  overdraw  triangles drawn over triangles, by clusters and by super-clusters: in one pass\n"
        "            for each channel, or all three at once",
        "paim-thesis-study");
    std::vector<std::string> inputs;
    Options options;
    uint32_t num_vertices = 6000;
    app.add_option("OBJ", inputs, kInputsHelp)->required();
    app.add_option("--name", options.name, "Name in the CSV; default: the first input");
    app.add_option("--vertices", num_vertices, "Of the octopus or the bowl")->capture_default_str();
    app.add_option("--brdf", options.brdfs, "NAME:NUMBER,NUMBER…; may be given again")
        ->capture_default_str();
    app.add_option("--clusters", options.clusters, "Numbers of clusters, 1 to 65535")
        ->delimiter(',')
        ->check(cli::in_range(1u, 65535u))
        ->capture_default_str();
    app.add_option("--components", options.components, "Of each cluster, 1 to 64")
        ->check(cli::in_range(1u, 64u))
        ->capture_default_str();
    app.add_option("--alpha", options.alpha,
                   "Share by which the squared error of a vertex may grow, 0 to 100")
        ->check(cli::in_range(0.0, 100.0))
        ->capture_default_str();
    app.add_option("--registers", options.registers, "Of four values, 1 to 65536")
        ->check(cli::in_range(1u, 65536u))
        ->capture_default_str();
    app.add_option("--in-bands", options.in_bands, "Bands of light, 1 to 16")
        ->check(cli::in_range(1u, 16u))
        ->capture_default_str();
    app.add_option("--out-bands", options.out_bands, "Bands of outgoing radiance, 1 to 8")
        ->check(cli::in_range(1u, kMaxOutBands))
        ->capture_default_str();
    app.add_option("--rays", options.rays, "Of a vertex, 1 to 65536")
        ->check(cli::in_range(1u, 65536u))
        ->capture_default_str();
    if (const int code = cli::parse(app, argc, argv); code >= 0) return code;
    if (options.name.empty()) options.name = inputs.front();
    run_study(*open_source(inputs, num_vertices, 1), options);
    return 0;
}

}  // namespace

int main(int argc, char** argv) {
    return paim::cli::run_main("paim-thesis-study", [&] { return run(argc, argv); });
}
