// paim-axes-study: what glossy transfer of a sequence costs if its outgoing side is stored in the axes
// of the pose, or in the frame of the vertex: tables of docs/results/gloss.md.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <memory>
#include <string>
#include <vector>

#include "analysis/study/gloss/frame_transfer.h"
#include "analysis/study/open_source.h"
#include "compressor/bake/bake_options.h"
#include "compressor/encode/cluster/clustered_pca.h"
#include "compressor/encode/svd/principal_components.h"
#include "compressor/material/brdfs.h"
#include "compressor/scene/root_motion.h"
#include "paim/cli/parse.h"
#include "paim/cli/run_main.h"
#include "paim/format/pack/plane_encoder.h"
#include "paim/mesh/tangent_frames.h"

namespace {

using namespace paim;
using namespace paim::study;
using Eigen::Index;
using Eigen::MatrixXf;

struct Options {
    std::string name;
    uint32_t num_poses = 24, in_bands = 5, out_bands = 4, rays = 2048;
    uint32_t clusters = 128, components = 8;
    std::vector<std::string> brdfs{"phong:0.5,32", "cook-torrance:0.5,0.4"};
    std::vector<double> errors{0.01, 0.02, 0.05};
};

// What the outgoing side is stored in.
enum class Axes { pose, frame };
constexpr Axes kAxes[] = {Axes::pose, Axes::frame};
const char* name_of(Axes axes) {
    return axes == Axes::pose ? "pose" : "frame";
}

// The poses in local axes, as bakes have them.
std::vector<Pose> local_poses(const PoseSource& source, uint32_t count) {
    const RootMotion motion = find_root_motion(source, RootMotionChoice::automatic);
    std::vector<Pose> poses;
    for (uint32_t p = 0; p < count; ++p) {
        Pose pose = load_from_origin(source, p);
        const RigidTransform root = root_at(motion, p);
        for (Vec3f& position : pose.positions) {
            position = root.to_local(position.cast<double>()).cast<float>();
        }
        for (Vec3f& normal : pose.normals) {
            normal = (root.rotation.conjugate() * normal.cast<double>()).cast<float>();
        }
        poses.push_back(std::move(pose));
    }
    return poses;
}

// A data matrix: rows plane-major, a column a pose.
struct Data {
    MatrixXf matrix;  // [planes · V][P]
    uint32_t num_planes = 0;
    double energy = 0.0;  // Σ x²
};

// A pose with transfer in the frames of its vertices.
struct FramedTransfer {
    std::vector<Eigen::Matrix3f> frames;
    MatrixXf transfer;  // [V][K · C]
};

std::vector<FramedTransfer> bake_frames(const Topology& topology, const std::vector<Pose>& poses,
                                        const ExitFunctions& exit, const Options& options) {
    const TangentFrames tangents(topology, poses[0].positions);
    std::vector<FramedTransfer> baked;
    for (uint32_t p = 0; p < poses.size(); ++p) {
        FrameTransferOptions transfer;
        transfer.in_bands = options.in_bands;
        transfer.rays = options.rays;
        transfer.pose = p;
        std::vector<Eigen::Matrix3f> frames = tangents.at(poses[p].positions, poses[p].normals);
        MatrixXf planes = frame_transfer(topology, poses[p], frames, exit, transfer);
        baked.push_back({std::move(frames), std::move(planes)});
    }
    return baked;
}

Data make_data(const std::vector<FramedTransfer>& poses, const ExitFunctions& exit, Axes axes) {
    Data data;
    for (size_t p = 0; p < poses.size(); ++p) {
        const auto& [frames, transfer] = poses[p];
        const MatrixXf planes =
            axes == Axes::pose ? in_pose_axes(transfer, frames, exit) : transfer;
        data.num_planes = static_cast<uint32_t>(planes.cols());
        data.matrix.resize(planes.size(), static_cast<Index>(poses.size()));
        data.matrix.col(static_cast<Index>(p)) = planes.reshaped();
        data.energy += planes.cast<double>().squaredNorm();
    }
    return data;
}

// Σ of what the first components leave, [K + 1] for 0 … all of them.
std::vector<double> squared_remainders(const PrincipalComponents& components) {
    const std::vector<double>& values = components.singular_values;
    std::vector<double> left(values.size() + 1, 0.0);
    for (size_t k = values.size(); k-- > 0;) left[k] = left[k + 1] + values[k] * values[k];
    return left;
}

uint32_t components_for(const std::vector<double>& left, double squared_error) {
    uint32_t k = 0;
    while (left[k] > squared_error) ++k;
    return k;
}

// Mean and components as multiples of a step, component after component, packed as files have them.
// Weights have unit RMS over the poses, so that each component adds step² / 12 to the squared error of
// every value.
size_t packed_bytes(const Data& data, const PrincipalComponents& components, uint32_t count,
                    double squared_rounding, const PlanePredictor& predictor) {
    const auto values = static_cast<double>(data.matrix.size());
    const double step = std::sqrt(12.0 * squared_rounding / (values * (count + 1)));
    const auto root = std::sqrt(static_cast<double>(data.matrix.cols()));
    const Eigen::VectorXd mean = data.matrix.cast<double>().rowwise().mean();
    size_t bytes = 0;
    for (uint32_t k = 0; k <= count; ++k) {
        Eigen::VectorXd factors = mean;
        if (k > 0) {
            const Eigen::VectorXd direction = components.v.col(static_cast<Index>(k) - 1);
            factors =
                (data.matrix * direction.cast<float>()).cast<double>() - mean * direction.sum();
            factors /= root;
        }
        std::vector<int16_t> integers(static_cast<size_t>(factors.size()));
        for (size_t r = 0; r < integers.size(); ++r) {
            const double steps = std::nearbyint(factors[static_cast<Index>(r)] / step);
            integers[r] = static_cast<int16_t>(std::clamp(steps, -32767.0, 32767.0));
        }
        bytes += encode_planes(integers, data.num_planes, predictor, Effort::fast).size();
    }
    return bytes;
}

class Study {
  public:
    Study(const PoseSource& source, const Options& options)
        : topology_(source.topology()),
          options_(options),
          poses_(local_poses(source, std::min(options.num_poses, source.num_poses()))),
          predictor_(topology_) {}

    void measure(const std::string& brdf) const {
        const ExitFunctions exit(*parse_brdf(brdf), static_cast<int>(options_.out_bands));
        const std::vector<FramedTransfer> baked = bake_frames(topology_, poses_, exit, options_);
        for (const Axes axes : kAxes) measure(brdf, axes, make_data(baked, exit, axes));
    }

  private:
    void measure(const std::string& brdf, Axes axes, const Data& data) const {
        const MatrixRows rows(data.matrix);
        const PrincipalComponents components = principal_components(rows);
        const std::vector<double> left = squared_remainders(components);
        const double grouped = clustered_share(rows, data);
        for (const double error : options_.errors) {
            const double squared = error * error * data.energy;
            const uint32_t count = components_for(left, squared);
            // Half of the squared error is left to rounding.
            const uint32_t coarse = components_for(left, 0.5 * squared);
            fmt::print("{},\"{}\",{},{},{},{:g},{},{},{},{:.6f}\n", options_.name, brdf,
                       name_of(axes), poses_.size(), data.num_planes, error, count,
                       (count + 1) * data.num_planes * 2,
                       packed_bytes(data, components, coarse, squared - left[coarse], predictor_),
                       grouped);
        }
        fmt::print(stderr, "{} {} {}: singular values", options_.name, brdf, name_of(axes));
        for (size_t k = 0; k < std::min<size_t>(8, components.singular_values.size()); ++k) {
            fmt::print(stderr, " {:.4f}", components.singular_values[k] / std::sqrt(data.energy));
        }
        fmt::print(stderr, "\n");
        std::fflush(stdout);
    }

    // Squared error of clustered components, as a share of Σ x². All axes have as many values in the
    // bases: those of the given number of clusters in the axes of the pose.
    double clustered_share(const RowSource& rows, const Data& data) const {
        const uint32_t of_pose =
            options_.in_bands * options_.in_bands * options_.out_bands * options_.out_bands;
        ClusteringOptions options;
        options.num_clusters = options_.clusters * of_pose / data.num_planes;
        options.assumed_components = options.max_components = options_.components;
        options.memory_bytes = 4'000'000'000;
        const ClusteredPca pca = clustered_pca(RowPlanes(rows, data.num_planes), options);
        return pca.squared_error(pca.num_components) / data.energy;
    }

    const Topology& topology_;
    const Options& options_;
    std::vector<Pose> poses_;
    PlanePredictor predictor_;
};

int run(int argc, char** argv) {
    CLI::App app(
        "Bakes glossy transfer of a sequence, with its outgoing side in the axes of the pose, and in\n"
        "the frames of the vertices. CSV on stdout: for each error, components of the mean-centred\n"
        "SVD, their bytes a vertex with two bytes a value, bytes of all packed as in files, and the\n"
        "squared error of clustered components of equal size, as a share. Singular values on\n"
        "stderr, as shares of the norm of all values.",
        "paim-axes-study");
    std::vector<std::string> inputs;
    Options options;
    uint32_t num_vertices = 6000;
    app.add_option("OBJ", inputs, kInputsHelp)->required();
    app.add_option("--name", options.name, "Name in the CSV; default: the first input");
    app.add_option("--vertices", num_vertices, "Of the octopus or the bowl")->capture_default_str();
    app.add_option("--poses", options.num_poses, "The first so many poses, 2 to 1000")
        ->check(cli::in_range(2u, 1000u))
        ->capture_default_str();
    app.add_option("--brdf", options.brdfs, "NAME:NUMBER,NUMBER…; may be given again")
        ->capture_default_str();
    app.add_option("--errors", options.errors,
                   "Errors relative to the RMS of all values, 0.0001 to 1")
        ->delimiter(',')
        ->check(cli::in_range(1e-4, 1.0))
        ->capture_default_str();
    app.add_option("--clusters", options.clusters, "In the axes of the pose, 1 to 4096")
        ->check(cli::in_range(1u, 4096u))
        ->capture_default_str();
    app.add_option("--components", options.components, "Of each cluster, 1 to 64")
        ->check(cli::in_range(1u, 64u))
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
    const auto source = open_source(inputs, num_vertices, options.num_poses);
    const Study study(*source, options);
    fmt::print(
        "sequence,brdf,axes,poses,planes,error,components,bytes_a_vertex,packed_bytes,"
        "clustered_squared_error\n");
    for (const std::string& brdf : options.brdfs) study.measure(brdf);
    return 0;
}

}  // namespace

int main(int argc, char** argv) {
    return paim::cli::run_main("paim-axes-study", [&] { return run(argc, argv); });
}
