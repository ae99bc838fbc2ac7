// The bake options of paim-compress.
#include "compressor/bake_arguments.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <limits>
#include <utility>
#include <vector>

#include "compressor/material/brdfs.h"
#include "compressor/material/gloss_bands.h"
#include "compressor/scene/root_motion.h"
#include "paim/base/error.h"
#include "paim/cli/help.h"
#include "paim/cli/parse.h"
#include "paim/format/bake/bake_directory.h"
#include "paim/sh/index.h"

namespace paim {

namespace {

// The default of --rays with --noise-target, where it is a limit.
constexpr uint32_t kMaxRays = 16384;

void add_input_options(CLI::App& app, CompressOptions& options, BakeArguments& arguments) {
    constexpr const char* kGroup = "Input";
    app.add_flag("--keep-order", options.keep_order,
                 "Take the files in the order given. Without it, files are sorted by the numbers "
                 "in their names: x_2 before x_10; t-2, t-1, t0; t.1, t.1.25, t.1.5. '-' and '.' "
                 "are a sign and a decimal point only where other names of the folder show it, and "
                 "separate numbers elsewhere: walk-01 before walk-02")
        ->group(kGroup);
    cli::add_choice(app, "--normals", options.normals, {"faces", "file"},
                    "Vertex normals: 'faces' averages the faces around a vertex, each by its angle "
                    "there, also across vertices that are doubled along seams; 'file' takes the "
                    "vn of the files, with hard edges where they have some")
        ->group(kGroup);
    app.add_flag("--orient", options.orient,
                 "Turn closed parts of the mesh that face inwards, which are named in warnings. "
                 "Parts inside another one stay, as they may be walls of a cavity")
        ->group(kGroup);
    app.add_option("--albedo", arguments.albedo,
                   "Diffuse reflectance of the poses, linear, three numbers or one for all, 0 to "
                   "1. Default: the vertex colours, else Kd of the materials, else 0.8")
        ->type_name("R,G,B")
        ->group(kGroup);
    cli::add_choice<ColourCurve>(app, "--vertex-colours", options.vertex_colours,
                                 {{"auto", ColourCurve::automatic},
                                  {"linear", ColourCurve::linear},
                                  {"srgb", ColourCurve::srgb}},
                                 "What the vertex colours of OBJ files are: linear values or sRGB "
                                 "ones, which are made linear. 'auto' takes them as sRGB if the "
                                 "file names an exporter that writes sRGB (Blender, MeshLab), else "
                                 "as linear. The report says which")
        ->group(kGroup);
    app.add_flag_callback(
           "--no-textures", [&options] { options.textures = false; },
           "Read no images of materials (map_Kd): their faces have the Kd of the material")
        ->group(kGroup);
    cli::add_choice<RootMotionChoice>(
        app, "--root-motion", options.root_motion,
        {{"auto", RootMotionChoice::automatic},
         {"none", RootMotionChoice::none},
         {"translation", RootMotionChoice::translation},
         {"rigid", RootMotionChoice::rigid}},
        "What is taken out of the poses and played back as one transform a pose: the path of the "
        "body ('translation'), its path and turns ('rigid'), or nothing. 'auto' takes what makes "
        "the poses much more alike. A --floor keeps its place")
        ->group(kGroup);
}

// The BRDFs, each with its numbers: "phong:ks,n, description; …".
std::string brdf_help() {
    std::string text;
    for (const BrdfType& type : brdf_types()) {
        text +=
            fmt::format("'{}:{}', {}; ", type.name, fmt::join(type.numbers, ","), type.description);
    }
    return text;
}

void add_gloss_options(CLI::App& app, CompressOptions& options, BakeArguments& arguments) {
    constexpr const char* kGroup = "Gloss";
    app.add_flag("--gloss", options.gloss.from_libraries,
                 "Bake the gloss of the material libraries: Pr and Pm become 'cook-torrance', Ks "
                 "and Ns 'phong' (docs/input.md). Without it materials are matte, as many "
                 "exporters write a Ks that nobody meant")
        ->group(kGroup);
    app.add_option("--material", arguments.materials,
                   fmt::format("Gloss of the whole mesh, or with NAME= that of one of its "
                               "materials, whatever the libraries say. SPEC is {}or 'matte'. May "
                               "be given several times. A floor is matte, and --static meshes have "
                               "the gloss of their libraries",
                               brdf_help()))
        ->allow_extra_args(false)
        ->type_name("[NAME=]SPEC")
        ->group(kGroup);
    app.add_option(
           "--gloss-bands", arguments.gloss_bands,
           fmt::format("Bands of glossy transfer: of the light, 1 to {}, and of the light "
                       "that leaves, 1 to {}. Default: as many as the materials need, at most "
                       "{} and {}",
                       sh::kMaxBands, kMaxOutBands, kMostChosenInBands, kMostChosenOutBands))
        ->type_name("IN,OUT")
        ->group(kGroup);
}

void add_surroundings_options(CLI::App& app, CompressOptions& options, BakeArguments& arguments) {
    constexpr const char* kGroup = "Floor and still meshes";
    CLI::Option* floor = app.add_flag("--floor", arguments.floor,
                                      "Put a ground just below the lowest point of all poses. It "
                                      "receives their shadow")
                             ->group(kGroup);
    app.add_option("--floor-albedo", arguments.floor_albedo,
                   "Diffuse reflectance of the floor, as for --albedo. Default: 0.8")
        ->needs(floor)
        ->option_text("R,G,B")
        ->group(kGroup);
    app.add_option("--floor-vertices", arguments.floor_vertices,
                   fmt::format("Largest number of vertices of the floor, {} to {}. More vertices "
                               "make sharper shadows",
                               kMinFloorVertices, kMaxFloorVertices))
        ->check(cli::in_range(kMinFloorVertices, kMaxFloorVertices))
        ->needs(floor)
        ->option_text(fmt::format("N={}", arguments.floor_vertices))
        ->group(kGroup);
    app.add_option("--static", options.statics,
                   "An OBJ file of a still mesh, with an albedo of its own. It blocks and bounces "
                   "the light of the poses, which cast no shadow on it. May be given several times")
        ->allow_extra_args(false)
        ->type_name("OBJ")
        ->group(kGroup);
}

void add_noise_options(CLI::App& app, CompressOptions& options, BakeArguments& arguments) {
    constexpr const char* kGroup = "Rays and noise";
    const std::string noise_target_help = fmt::format(
        "Trace rays at each vertex until its estimated noise is below this share of the transfer "
        "of an unshadowed vertex, such as 2%. --rays is then the limit, {} by default",
        kMaxRays);
    app.add_option("--noise-target", arguments.noise_target, noise_target_help)
        ->type_name("ERROR")
        ->group(kGroup);
    app.add_option("--transfer-error", arguments.transfer_error, "Former name of --noise-target")
        ->group(cli::kHiddenGroup);
    cli::add_choice<Streams>(app, "--pose-noise", options.bake.streams,
                             {{"independent", Streams::per_pose},
                              {"shared", Streams::shared},
                              {"mixed", Streams::mixed}},
                             "The noise of different poses: 'independent' averages out when "
                             "encoded, 'shared' moves with the mesh and does not flicker, "
                             "'mixed' is half of each")
        ->group(kGroup);
    std::vector<std::pair<std::string, Streams>> former_names;
    for (const Streams streams : kStreams)
        former_names.emplace_back(streams_name(streams), streams);
    cli::add_choice(app, "--streams", options.bake.streams, former_names,
                    "Former name of --pose-noise")
        ->group(cli::kHiddenGroup);
    std::vector<std::pair<std::string, SamplerKind>> samplers;
    for (const SamplerKind kind : kSamplerKinds) samplers.emplace_back(sampler_name(kind), kind);
    cli::add_choice(app, "--sampler", options.bake.sampler, samplers,
                    "Directions of the rays: 'cosine' (low-discrepancy, the best); for reference "
                    "'uniform' (random over the sphere) and 'uniform-sobol'")
        ->group(kGroup);
    app.add_option("--seed", options.bake.seed, "Seed of the random numbers, 0 to 2^64 - 1")
        ->check(cli::in_range(uint64_t{0}, std::numeric_limits<uint64_t>::max()))
        ->capture_default_str()
        ->type_name("N")
        ->group(kGroup);
}

void apply_gloss(const BakeArguments& arguments, CompressOptions& options) {
    for (const std::string& text : arguments.materials) {
        options.gloss.overrides.push_back(parse_gloss_override(text));
    }
    if (arguments.gloss_bands.empty()) return;
    const std::vector<uint32_t> bands =
        cli::parse_list(arguments.gloss_bands, "--gloss-bands", 1, sh::kMaxBands);
    if (bands.size() != 2 || bands[1] > kMaxOutBands) {
        throw_usage("--gloss-bands: expected IN,OUT with IN up to {} and OUT up to {}, got '{}'",
                    sh::kMaxBands, kMaxOutBands, arguments.gloss_bands);
    }
    options.bake.gloss_in_bands = bands[0];
    options.bake.gloss_out_bands = bands[1];
}

void apply_noise_target(const BakeArguments& arguments, CompressOptions& options) {
    const bool former = !arguments.transfer_error.empty();
    if (former && !arguments.noise_target.empty()) {
        throw_usage("--transfer-error: is the former name of --noise-target, which is given too");
    }
    const std::string& text = former ? arguments.transfer_error : arguments.noise_target;
    if (text.empty()) return;
    options.bake.transfer_error =
        cli::parse_share(text, former ? "--transfer-error" : "--noise-target");
    options.bake.rays = kMaxRays;
}

}  // namespace

void add_everyday_bake_options(CLI::App& app, CompressOptions& options, BakeArguments& arguments) {
    app.add_option("OBJ", options.inputs,
                   "The poses: OBJ files, quoted patterns ('poses/*.obj') or directories. All have "
                   "the same faces. Taken in natural order: x_2 before x_10. Hidden files are "
                   "passed over. Gaps in the numbers are noted")
        ->type_name("");
    app.add_option(
           "--rays", arguments.rays,
           fmt::format("Rays per vertex and pose, even, 2 to {}. More rays, less noise", kMostRays))
        ->check(cli::in_range(uint32_t{2}, kMostRays))
        ->default_str(std::to_string(options.bake.rays))
        ->type_name("N");
    app.add_option("--bands", options.bake.bands,
                   fmt::format("Spherical-harmonic bands, 1 to {}; B bands are B*B coefficients",
                               sh::kMaxBands))
        ->check(cli::in_range(1, static_cast<int>(sh::kMaxBands)))
        ->capture_default_str()
        ->type_name("B");
    app.add_option("--bounces", options.bake.bounces,
                   fmt::format("Bounces of light between surfaces, 0 to {}. Bounces off colours "
                               "make the bake three times as large",
                               kMaxBounces))
        ->check(cli::in_range(uint32_t{0}, kMaxBounces))
        ->capture_default_str()
        ->type_name("N");
}

void add_bake_options(CLI::App& app, CompressOptions& options, BakeArguments& arguments) {
    add_input_options(app, options, arguments);
    add_gloss_options(app, options, arguments);
    add_surroundings_options(app, options, arguments);
    add_noise_options(app, options, arguments);
}

void apply(const BakeArguments& arguments, CompressOptions& options) {
    if (!arguments.albedo.empty()) {
        options.albedo = cli::parse_color(arguments.albedo, "--albedo");
    }
    if (arguments.floor) {
        options.floor.emplace().num_vertices = arguments.floor_vertices;
        if (!arguments.floor_albedo.empty()) {
            options.floor->albedo = cli::parse_color(arguments.floor_albedo, "--floor-albedo");
        }
    }
    apply_gloss(arguments, options);
    apply_noise_target(arguments, options);
    if (arguments.rays) options.bake.rays = *arguments.rays;
    if (options.bake.rays % 2 != 0) {
        throw_usage("--rays: expected an even number (two halves), got {}", options.bake.rays);
    }
}

}  // namespace paim
