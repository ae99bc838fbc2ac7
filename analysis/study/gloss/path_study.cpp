// paim-path-study compares pictures of a file with traced paths of its bake, for docs/results/gloss.md.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "analysis/reference/path/path_picture.h"
#include "analysis/study/gloss/picture_distance.h"
#include "compressor/bake/bake_options.h"
#include "compressor/material/brdfs.h"
#include "paim/base/error.h"
#include "paim/cli/parse.h"
#include "paim/cli/run_main.h"
#include "paim/codec/playback.h"
#include "paim/format/bake/bake_directory.h"
#include "paim/format/paim/paim_read.h"
#include "paim/image/png.h"
#include "paim/light/load_light.h"
#include "paim/light/sky.h"
#include "paim/mesh/bounds.h"
#include "paim/mesh/planes.h"
#include "paim/sh/basis.h"

namespace {

using namespace paim;
using namespace paim::study;

struct Options {
    std::filesystem::path file, bake, env, picture;
    uint32_t pose = 0;
    std::vector<double> turns_deg{0.0};
    int size = 256;
    PathSettings paths;
};

// Adds a baked pose, moved to the scene.
void add(const Topology& topology, const Albedo& albedo, const Materials& materials,
         const BakedPose& pose, const RigidTransform& root, uint32_t num_following,
         TracedMesh& mesh, Materials& all) {
    std::vector<float> positions = pose.positions;
    move_to_scene(root, positions, num_following);
    std::vector<Vec3f> normals = from_planes(pose.normals);
    for (size_t v = 0; v < std::min<size_t>(num_following, normals.size()); ++v) {
        normals[v] = (root.rotation * normals[v].cast<double>()).normalized().cast<float>();
    }
    all.append(materials, mesh.topology.num_vertices, topology.num_vertices);
    mesh.append({topology, albedo, from_planes(positions), std::move(normals)});
}

// What paths see: all meshes of a pose, with their materials.
struct PathScene {
    TracedMesh mesh;
    PathMaterials materials;

    PathScene(const BakeReader& bake, uint32_t p) {
        const BakeIdentity& identity = bake.identity();
        const BakedPose pose = bake.read_pose(p);
        add(bake.topology(), bake.albedo(), bake.materials(), pose,
            root_at(identity.root_motion, p), identity.num_following, mesh, materials.materials);
        if (bake.still_mesh()) {
            const BakedStillMesh& still = *bake.still_mesh();
            add(still.topology, still.albedo, still.materials, still.pose, {}, kAllVertices, mesh,
                materials.materials);
        }
        for (const GlossMaterial& material : materials.materials.glossy) {
            materials.brdfs.push_back(parse_brdf(material.brdf));
        }
    }
};

// The map turned about +Y, to the nearest pixel.
EnvironmentLight turned_map(const EnvironmentLight& map, double angle_deg) {
    const Image& image = map.image();
    const int shift = static_cast<int>(std::lround(angle_deg / 360.0 * image.width));
    Image turned(image.width, image.height);
    for (int y = 0; y < image.height; ++y) {
        for (int x = 0; x < image.width; ++x) {
            const int from = ((x + shift) % image.width + image.width) % image.width;
            turned.at(x, y) = image.at(from, y);
        }
    }
    return EnvironmentLight(std::move(turned));
}

// Adds the gloss of a part at each pixel: interpolated coefficients towards the eye.
void add_gloss(const Playback& playback, size_t part, const VisiblePoints& visible,
               const Camera& camera, Image& image) {
    const CodedMesh& mesh = playback.asset().parts[part];
    if (!mesh.gloss) return;
    const std::span<const Vec3f> exit = playback.exit_radiance(part);
    const size_t num_rows = mesh.gloss->num_rows;
    std::vector<int64_t> row_of(mesh.topology.num_vertices, -1);
    for (uint32_t r = 0; r < num_rows; ++r) row_of[mesh.gloss->vertex(r)] = r;
    const auto out_bands = static_cast<int>(mesh.gloss->layout.out_bands);
    std::vector<float> basis(static_cast<size_t>(sh::num_coefficients(out_bands)));
    for (size_t pixel = 0; pixel < visible.hits.size(); ++pixel) {
        const Hit& hit = visible.hits[pixel];
        if (hit.triangle == kNoTriangle) continue;
        const Vec3d out = towards_eye(camera, visible, pixel).cast<double>();
        sh::evaluate_basis(out_bands, playback.root(part).rotation.conjugate() * out,
                           std::span(basis));
        const Triangle& t = mesh.topology.triangles[hit.triangle];
        const float weights[] = {1.0f - hit.u - hit.v, hit.u, hit.v};
        for (size_t c = 0; c < 3; ++c) {
            for (size_t o = 0; o < basis.size() && row_of[t[c]] >= 0; ++o) {
                image.pixels[pixel] +=
                    weights[c] * basis[o] * exit[o * num_rows + static_cast<size_t>(row_of[t[c]])];
            }
        }
    }
}

// What the file shows: where parts cover each other, the nearer one.
Image draw_file(const Playback& playback, const Camera& camera, int size) {
    Image image(size, size);
    std::vector<float> distance(image.pixels.size(), std::numeric_limits<float>::infinity());
    for (size_t part = 0; part < playback.num_parts(); ++part) {
        const CodedMesh& mesh = playback.asset().parts[part];
        const std::vector<Vec3f> positions = from_planes(playback.positions(part));
        const VisiblePoints visible = find_visible(mesh.topology, positions, camera, size, size);
        Image of_part = interpolate_image(visible, mesh.topology, playback.radiance(part));
        add_gloss(playback, part, visible, camera, of_part);
        for (size_t pixel = 0; pixel < image.pixels.size(); ++pixel) {
            const Hit& hit = visible.hits[pixel];
            if (hit.triangle == kNoTriangle) continue;
            const Triangle& t = mesh.topology.triangles[hit.triangle];
            const Vec3f place = (1.0f - hit.u - hit.v) * positions[t[0]] + hit.u * positions[t[1]] +
                                hit.v * positions[t[2]];
            const float far = (place - camera.eye).norm();
            if (far >= distance[pixel]) continue;
            distance[pixel] = far;
            image.pixels[pixel] = of_part.pixels[pixel];
        }
    }
    return image;
}

// Two pictures, left and right, below those that are there.
void append_row(const Image& left, const Image& right, Image& all) {
    Image more(2 * left.width, all.height + left.height);
    std::copy(all.pixels.begin(), all.pixels.end(), more.pixels.begin());
    for (int y = 0; y < left.height; ++y) {
        for (int x = 0; x < left.width; ++x) {
            more.at(x, all.height + y) = left.at(x, y);
            more.at(left.width + x, all.height + y) = right.at(x, y);
        }
    }
    all = std::move(more);
}

// 0.8 for all but a hundredth of the values that are not black.
float exposure_of(const Image& image) {
    std::vector<float> values;
    for (const Vec3f& pixel : image.pixels) {
        if (!pixel.isZero(0.0f)) values.push_back(pixel.maxCoeff());
    }
    if (values.empty()) return 1.0f;
    const auto high = values.begin() + static_cast<ptrdiff_t>(values.size() * 99 / 100);
    std::nth_element(values.begin(), high, values.end());
    return 0.8f / std::max(*high, 1e-6f);
}

void study(const Options& options) {
    const BakeReader bake(options.bake);
    if (options.pose >= bake.num_poses()) {
        throw_usage("--pose {}: expected 0 to {}", options.pose, bake.num_poses() - 1);
    }
    const auto asset = std::make_shared<const Asset>(read_paim(options.file));
    if (!asset->moving().gloss) throw_bad_input("{}: has no gloss", options.file.string());
    const EnvironmentLight map =
        options.env.empty() ? EnvironmentLight(make_sky()) : load_light(options.env).light;
    const PathScene scene(bake, options.pose);
    PathSettings paths = options.paths;
    paths.bounces = bake.identity().bounces;
    Playback playback(asset);
    playback.keep_exit_radiance(true);
    playback.update(options.pose);
    // What is glossy fills the picture.
    const CodedGloss& gloss = asset->moving().gloss.value();
    Bounds bounds;
    const std::vector<Vec3f> placed = from_planes(playback.positions());
    for (uint32_t r = 0; r < gloss.num_rows; ++r) bounds.extend(placed[gloss.vertex(r)]);
    const Camera camera = frame_bounds(bounds, 1.0f, kDefaultAzimuth_rad, kDefaultElevation_rad);
    const VisiblePoints visible =
        find_visible(scene.mesh.topology, scene.mesh.positions, camera, options.size, options.size);
    Image all;
    float exposure = 1.0f;
    fmt::print("pose,turn_deg,bounces,relative_rms,reference_noise\n");
    for (const double turn_deg : options.turns_deg) {
        const EnvironmentLight light = turned_map(map, turn_deg);
        const MapLight path_light(light);
        const PathTracer tracer(scene.mesh, scene.materials, path_light);
        const PathPicture reference = trace_picture(tracer, visible, camera, paths);
        playback.set_light(light);
        playback.update(options.pose);
        const Image drawn = draw_file(playback, camera, options.size);
        const double squared = squared_sum(reference.mean);
        fmt::print("{},{:g},{},{:.5f},{:.5f}\n", options.pose, turn_deg, paths.bounces,
                   std::sqrt(squared_distance(drawn, reference.mean, LitBy::both) / squared),
                   std::sqrt(squared_sum(reference.standard_error) / squared));
        if (all.height == 0) exposure = exposure_of(reference.mean);
        append_row(reference.mean, drawn, all);
    }
    if (options.picture.empty()) return;
    ToneCurve curve;
    curve.exposure_ev = std::log2(exposure);
    write_png(options.picture, all, curve);
}

int run(int argc, char** argv) {
    CLI::App app(
        "Draws a pose of a file with its gloss at each pixel, and the same pose of its bake by traced\n"
        "paths, with diffuse and glossy reflection and as many bounces as the bake has. Prints the RMS\n"
        "difference relative to the RMS of the paths' picture, over pixels that both cover, with the\n"
        "paths' own noise, as CSV on stdout.",
        "paim-path-study");
    Options options;
    app.add_option("PAIM", options.file, "The file")->required();
    app.add_option("BAKE", options.bake, "The .bake directory that it was made from")->required();
    app.add_option("--env", options.env, "Environment map, EXR; default: the built-in sky");
    app.add_option("--pose", options.pose, "Counted from 0")->capture_default_str();
    app.add_option("--turns", options.turns_deg, "Angles of the light about +Y, degrees")
        ->delimiter(',')
        ->check(cli::in_range(-360.0, 360.0))
        ->capture_default_str();
    app.add_option("--size", options.size, "Width and height, pixels, 16 to 1024")
        ->check(cli::in_range(16, 1024))
        ->capture_default_str();
    app.add_option("--batches", options.paths.batches, "Of paths of a pixel, 2 to 1024")
        ->check(cli::in_range(2u, 1024u))
        ->capture_default_str();
    app.add_option("--paths", options.paths.paths, "Of a batch, 1 to 65536")
        ->check(cli::in_range(1u, 65536u))
        ->capture_default_str();
    app.add_option("-o,--output", options.picture,
                   "PNG: a row for each turn, paths on the left, the file on the right");
    if (const int code = cli::parse(app, argc, argv); code >= 0) return code;
    study(options);
    return 0;
}

}  // namespace

int main(int argc, char** argv) {
    return paim::cli::run_main("paim-path-study", [&] { return run(argc, argv); });
}
