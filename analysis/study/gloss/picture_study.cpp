// paim-gloss-study: errors of pictures whose gloss comes from spherical harmonics, to traced paths: a
// table of docs/results/gloss.md.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "analysis/reference/path/path_picture.h"
#include "analysis/study/gloss/frame_transfer.h"
#include "analysis/study/gloss/picture_distance.h"
#include "analysis/study/open_source.h"
#include "compressor/bake/bake_options.h"
#include "compressor/material/brdfs.h"
#include "paim/cli/parse.h"
#include "paim/cli/run_main.h"
#include "paim/light/load_light.h"
#include "paim/light/sky.h"
#include "paim/mesh/bounds.h"
#include "paim/mesh/face_vertices.h"
#include "paim/mesh/tangent_frames.h"
#include "paim/sh/basis.h"

namespace {

using namespace paim;
using namespace paim::study;
using Eigen::Index;

struct Options {
    std::string name;
    uint32_t rays = 1024, light_bands = 0;
    uint32_t least_in = 3, most_in = 8, least_out = 3, most_out = 6;
    int size = 128;
    PathSettings paths;
    std::vector<std::string> brdfs{"phong:0.5,5",           "phong:0.5,20",
                                   "phong:0.5,100",         "cook-torrance:0.5,0.7",
                                   "cook-torrance:0.5,0.5", "cook-torrance:0.5,0.3"};
};

// The first pose through a camera, under a light.
struct Scene {
    TracedMesh mesh;
    Pose pose;
    Camera camera;
    VisiblePoints visible;
    LightCoefficients light;  // of the most bands
    std::unique_ptr<PathLight> path_light;
};

Scene make_scene(const PoseSource& source, const EnvironmentLight& map, const Options& options) {
    Scene scene;
    scene.pose = source.load_pose(0);
    scene.mesh = {source.topology(), source.albedo(), scene.pose.positions, scene.pose.normals};
    Bounds bounds;
    for (const uint32_t v : face_vertices(source.topology()))
        bounds.extend(scene.pose.positions[v]);
    scene.camera = frame_bounds(bounds, 1.0f, kDefaultAzimuth_rad, kDefaultElevation_rad);
    scene.visible = find_visible(source.topology(), scene.pose.positions, scene.camera,
                                 options.size, options.size);
    scene.light = map.coefficients(static_cast<int>(options.most_in));
    if (options.light_bands == 0) {
        scene.path_light = std::make_unique<MapLight>(map);
        return scene;
    }
    const LightCoefficients few = map.coefficients(static_cast<int>(options.light_bands));
    scene.path_light = std::make_unique<BandLight>(few);
    std::fill(scene.light.values.begin(), scene.light.values.end(), Vec3f::Zero());
    const size_t count = std::min(few.values.size(), scene.light.values.size());
    std::copy_n(few.values.begin(), count, scene.light.values.begin());
    return scene;
}

// Outgoing radiance by transfer with some bands of light.
// transfer  [V][O · C]
// returns   [V · O] Vec3f, outgoing coefficient o of vertex v at v · O + o
std::vector<Vec3f> outgoing(const Eigen::MatrixXf& transfer, const LightCoefficients& light,
                            uint32_t in_bands) {
    const auto num_incident = static_cast<Index>(light.values.size());
    const Index num_outgoing = transfer.cols() / num_incident;
    std::vector<Vec3f> radiance(static_cast<size_t>(transfer.rows() * num_outgoing));
    for (Index v = 0; v < transfer.rows(); ++v) {
        for (Index o = 0; o < num_outgoing; ++o) {
            Vec3f sum = Vec3f::Zero();
            for (uint32_t i = 0; i < in_bands * in_bands; ++i) {
                sum += transfer(v, o * num_incident + i) * light.values[i];
            }
            radiance[static_cast<size_t>(v * num_outgoing + o)] = sum;
        }
    }
    return radiance;
}

// A picture of gloss whose coefficients are interpolated and evaluated at each pixel.
// radiance  of outgoing(), of most_out bands
Image draw(const Scene& scene, const std::vector<Vec3f>& radiance, uint32_t most_out,
           uint32_t out_bands) {
    Image image(scene.visible.width, scene.visible.height);
    const size_t stride = size_t{most_out} * most_out, count = size_t{out_bands} * out_bands;
    std::vector<float> basis(count);
    for (size_t pixel = 0; pixel < scene.visible.hits.size(); ++pixel) {
        const Hit& hit = scene.visible.hits[pixel];
        if (hit.triangle == kNoTriangle) continue;
        const Vec3f out = towards_eye(scene.camera, scene.visible, pixel);
        sh::evaluate_basis(static_cast<int>(out_bands), out.cast<double>(), std::span(basis));
        const Triangle& t = scene.mesh.topology.triangles[hit.triangle];
        const float weights[] = {1.0f - hit.u - hit.v, hit.u, hit.v};
        for (size_t c = 0; c < 3; ++c) {
            for (size_t o = 0; o < count; ++o) {
                image.pixels[pixel] += weights[c] * basis[o] * radiance[t[c] * stride + o];
            }
        }
    }
    return image;
}

void measure(const Scene& scene, const std::string& text, const Options& options) {
    PathMaterials materials;
    materials.brdfs.push_back(parse_brdf(text));
    materials.materials.glossy = {{text, Vec3f::Ones()}};
    materials.materials.of_vertex = {1};
    const PathTracer tracer(scene.mesh, materials, *scene.path_light);
    const PathPicture reference = trace_picture(tracer, scene.visible, scene.camera, options.paths);
    const double all = squared_sum(reference.mean);
    const double noise = std::sqrt(squared_sum(reference.standard_error) / all);

    const ExitFunctions exit(*materials.brdfs[0], static_cast<int>(options.most_out));
    FrameTransferOptions transfer;
    transfer.in_bands = options.most_in;
    transfer.rays = options.rays;
    const auto frames = TangentFrames(scene.mesh.topology, scene.pose.positions)
                            .at(scene.pose.positions, scene.pose.normals);
    const Eigen::MatrixXf baked = in_pose_axes(
        frame_transfer(scene.mesh.topology, scene.pose, frames, exit, transfer), frames, exit);
    for (uint32_t in = options.least_in; in <= options.most_in; ++in) {
        const std::vector<Vec3f> radiance = outgoing(baked, scene.light, in);
        for (uint32_t out = options.least_out; out <= options.most_out; ++out) {
            const Image image = draw(scene, radiance, options.most_out, out);
            fmt::print("{},\"{}\",{},{},{},{:.5f},{:.5f}\n", options.name, text,
                       options.light_bands, in, out,
                       std::sqrt(squared_distance(image, reference.mean, LitBy::reference) / all),
                       noise);
        }
    }
    std::fflush(stdout);
}

int run(int argc, char** argv) {
    CLI::App app(
        "Draws the gloss of the first pose under an environment map, from spherical harmonics and by\n"
        "traced paths, and prints the RMS difference over lit pixels relative to the RMS of the\n"
        "paths' picture, with the paths' own noise. CSV on stdout.",
        "paim-gloss-study");
    std::vector<std::string> inputs;
    std::filesystem::path env;
    Options options;
    uint32_t num_vertices = 6000;
    options.paths.seen.diffuse = false;
    app.add_option("OBJ", inputs, kInputsHelp)->required();
    app.add_option("--name", options.name, "Name in the CSV; default: the first input");
    app.add_option("--vertices", num_vertices, "Of the octopus or the bowl")->capture_default_str();
    app.add_option("--env", env, "Environment map, EXR; default: the built-in sky");
    app.add_option("--brdf", options.brdfs, "NAME:NUMBER,NUMBER…; may be given again")
        ->capture_default_str();
    app.add_option("--light-bands", options.light_bands,
                   "Paths end in so many bands of the light, to 64; 0: in the map itself")
        ->check(cli::in_range(0u, 64u))
        ->capture_default_str();
    app.add_option("--most-in", options.most_in, "Bands of light up to this number, 3 to 16")
        ->check(cli::in_range(3u, 16u))
        ->capture_default_str();
    app.add_option("--most-out", options.most_out, "Bands of outgoing radiance, 3 to 8")
        ->check(cli::in_range(3u, kMaxOutBands))
        ->capture_default_str();
    app.add_option("--size", options.size, "Width and height, pixels, 16 to 1024")
        ->check(cli::in_range(16, 1024))
        ->capture_default_str();
    app.add_option("--rays", options.rays, "Of a vertex, 1 to 65536")
        ->check(cli::in_range(1u, 65536u))
        ->capture_default_str();
    app.add_option("--batches", options.paths.batches, "Of paths of a pixel, 2 to 1024")
        ->check(cli::in_range(2u, 1024u))
        ->capture_default_str();
    app.add_option("--paths", options.paths.paths, "Of a batch, 1 to 65536")
        ->check(cli::in_range(1u, 65536u))
        ->capture_default_str();
    if (const int code = cli::parse(app, argc, argv); code >= 0) return code;
    if (options.name.empty()) options.name = inputs.front();
    const auto source = open_source(inputs, num_vertices, 1);
    const EnvironmentLight map = env.empty() ? EnvironmentLight(make_sky()) : load_light(env).light;
    const Scene scene = make_scene(*source, map, options);
    fmt::print("sequence,brdf,light_bands,in_bands,out_bands,relative_rms,reference_noise\n");
    for (const std::string& text : options.brdfs) measure(scene, text, options);
    return 0;
}

}  // namespace

int main(int argc, char** argv) {
    return paim::cli::run_main("paim-gloss-study", [&] { return run(argc, argv); });
}
