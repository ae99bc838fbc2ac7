// The command line of paim-compress.
#include "compressor/options.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <limits>
#include <vector>

#include "paim/base/check.h"
#include "paim/base/error.h"
#include "paim/cli/parse.h"

namespace paim {

namespace {

constexpr uint64_t kMinMemoryBytes = 64'000'000;

// The options as text, where their form needs checking after parsing.
struct RawOptions {
    std::string albedo;
    bool floor = false;
    std::string floor_albedo;
    uint32_t floor_vertices = FloorOptions().num_vertices;
    std::string geometry_components = "auto";
    std::string transfer_components = "auto";
    std::string precision = "auto";
    RawTarget target;
    std::string noise = "shrink";
    std::string auto_transfer_error = "1%";
    std::string memory = "1G";
    std::string transfer_error;
    std::string sampler = sampler_name(BakeOptions().sampler);
    std::string streams = streams_name(BakeOptions().streams);
    std::optional<uint32_t> rays;
    uint32_t encode_bands = 0;
};

// What options call the values of an enum.
template <typename Kind, size_t N>
std::vector<std::string> names_of(const Kind (&kinds)[N], const char* (*name)(Kind)) {
    std::vector<std::string> names;
    for (const Kind kind : kinds) names.emplace_back(name(kind));
    return names;
}

// The value of a name, which is one of them (CLI::IsMember).
template <typename Kind, size_t N>
Kind kind_of(const std::string& text, const Kind (&kinds)[N], const char* (*name)(Kind)) {
    const auto found =
        std::find_if(kinds, kinds + N, [&](Kind kind) { return text == name(kind); });
    PAIM_CHECK(found != kinds + N);
    return *found;
}

// The default of --rays where the rays are those a vertex may take at most.
constexpr uint32_t kMaxRays = 16384;

void add_input_options(CLI::App& app, CompressOptions& options) {
    app.add_option(
        "OBJ", options.inputs,
        "Poses: OBJ files, quoted patterns ('poses/*.obj') or directories, one topology; "
        "taken in natural order (x_2 before x_10)");
    app.add_flag("--keep-order", options.keep_order, "Take files in the order given instead");
    app.add_option("--normals", options.normals,
                   "Vertex normals: 'faces' averages the faces round a vertex, 'file' takes the "
                   "files' vn")
        ->check(CLI::IsMember({"faces", "file"}))
        ->capture_default_str();
}

void add_bake_options(CLI::App& app, CompressOptions& options, RawOptions& raw) {
    app.add_option("--rays", raw.rays,
                   fmt::format("Rays per vertex and pose, even, 2 to 16777216; more rays, less "
                               "noise; with --transfer-error the most (then {})",
                               kMaxRays))
        ->check(cli::in_range(uint32_t{2}, uint32_t{1} << 24))
        ->default_str(std::to_string(options.bake.rays));
    app.add_option(
        "--transfer-error", raw.transfer_error,
        "Instead of a fixed count: each vertex takes rays until the estimated error of "
        "its transfer is below this fraction (0.02, 2%) of that of a vertex that nothing "
        "shadows; bounces come on top");
    app.add_option("--sampler", raw.sampler,
                   "Directions of the rays: 'cosine' (low-discrepancy, best), or as references "
                   "'uniform' (random over the sphere), 'uniform-sobol'")
        ->check(CLI::IsMember(names_of(kSamplerKinds, &sampler_name)))
        ->capture_default_str();
    app.add_option(
           "--streams", raw.streams,
           "Random numbers: independent 'per-pose', 'shared' by all poses, or 'mixed' (half "
           "of the rays each)")
        ->check(CLI::IsMember(names_of(kStreams, &streams_name)))
        ->capture_default_str();
    app.add_option("--albedo", raw.albedo,
                   "Diffuse reflectance of the poses R,G,B (or one number), linear, 0 to 1; "
                   "default: vertex colours, else Kd of the materials, else 0.8. The floor has "
                   "--floor-albedo, files of --static what they say themselves");
    app.add_option(
           "--bounces", options.bake.bounces,
           fmt::format("How often light may bounce before it reaches a vertex, 0 to {}; with "
                       "colours a bake that bounces is three times as large",
                       kMaxBounces))
        ->check(cli::in_range(uint32_t{0}, kMaxBounces))
        ->capture_default_str();
    CLI::Option* floor =
        app.add_flag("--floor", raw.floor,
                     "Put a ground under the poses, just below the lowest point of all: it gets "
                     "their shadow and is lit and compressed with them");
    app.add_option("--floor-albedo", raw.floor_albedo,
                   "Diffuse reflectance R,G,B (or one number) of the floor, linear, 0 to 1; "
                   "default: 0.8, whatever --albedo is")
        ->needs(floor);
    app.add_option("--floor-vertices", raw.floor_vertices,
                   fmt::format("The most vertices that the floor may have, {} to {}; more make its "
                               "shadows sharper",
                               kMinFloorVertices, kMaxFloorVertices))
        ->check(cli::in_range(kMinFloorVertices, kMaxFloorVertices))
        ->capture_default_str()
        ->needs(floor);
    app.add_option("--static", options.statics,
                   "An OBJ file of scenery, which blocks and bounces the poses' light but is "
                   "stored once; may be given several times. The poses cast no shadow on it: for "
                   "that there is --floor. Its albedo is its vertex colours, else Kd of its "
                   "materials, else 0.8, whatever --albedo is")
        ->allow_extra_args(false);
    app.add_option("--seed", options.bake.seed, "Seed of the random streams, 0 to 2^64 - 1")
        ->check(cli::in_range(uint64_t{0}, std::numeric_limits<uint64_t>::max()))
        ->capture_default_str();
}

void add_encode_options(CLI::App& app, CompressOptions& options, RawOptions& raw) {
    app.add_option("--geometry-components", raw.geometry_components,
                   "Components of the geometry: a number, 'all', or 'auto'")
        ->capture_default_str();
    app.add_option("--transfer-components", raw.transfer_components,
                   "Components of the transfer: a number, 'all', or 'auto'")
        ->capture_default_str();
    app.add_option(
           "--auto-transfer-error", raw.auto_transfer_error,
           "What 'auto' keeps the transfer's signal error below, its energy error without the "
           "bake's noise, a fraction or percentage; "
           "components that are nothing but bake noise are never kept (the geometry's is "
           "always 1 %)")
        ->capture_default_str();
    app.add_option("--noise", raw.noise,
                   "Bake noise in the transfer's components: 'shrink' scales them down by what of "
                   "them is noise, 'keep' leaves them ('all' components are always kept as baked)")
        ->check(CLI::IsMember({"shrink", "keep"}))
        ->capture_default_str();
    app.add_option(
           "--precision", raw.precision,
           "How components are stored: f32, f16 (half the size, relative rounding 0.05 %; "
           "means and weights stay f32), or integers that the error allows: 'auto' is those "
           "with --max-error or --max-size, else f32. Floats are always coded as svd")
        ->check(CLI::IsMember({"auto", "f32", "f16"}))
        ->capture_default_str();
    add_target_options(app, raw.target);
    app.add_flag(
        "--measure", options.encode.measure,
        "Measure the file when it is written, and state its errors in it, as is always done "
        "with --max-error and --max-size; takes memory for three times the whole of it and six "
        "coefficients of all poses, which is checked before anything is written");
    app.add_option(
           "--memory", raw.memory,
           "Memory that encoding stays below, bytes or with K, M, G or T for powers of 1000; "
           "at least 64M, and about 130 bytes times the square of the number of poses and 40 for "
           "each vertex and band; more for --max-error and --max-size, which hold all that may be "
           "kept; the result is the same for any")
        ->capture_default_str();
    app.add_option("--fps", options.encode.frames_per_second,
                   "Poses per second at which the animation plays, 0.001 to 1000000")
        ->check(cli::in_range(1e-3, 1e6))
        ->capture_default_str();
}

void add_common_options(CLI::App& app, CompressOptions& options, const std::string& output_help) {
    app.add_option("-o,--output", options.output, output_help)->required();
    app.add_option("--threads", options.num_threads,
                   "Threads, 0 to 1024; 0 takes every core; the result is the same for any number")
        ->check(cli::in_range(0, 1024))
        ->capture_default_str();
    app.add_flag("--json", options.json, "Write one JSON object on stdout and nothing else");
    app.add_flag("--quiet", options.quiet, "Show no progress");
}

ComponentChoice parse_components(const std::string& text, const std::string& option) {
    if (text == "auto") return {ComponentChoice::Kind::automatic, 0};
    if (text == "all") return {ComponentChoice::Kind::all, 0};
    ComponentChoice choice{ComponentChoice::Kind::number, 0};
    const auto [end, failure] =
        std::from_chars(text.data(), text.data() + text.size(), choice.number);
    if (failure != std::errc() || end != text.data() + text.size()) {
        throw_usage("{}: expected a number, 'auto' or 'all', got '{}'", option, text);
    }
    return choice;
}

void apply(const RawOptions& raw, CompressOptions& options) {
    if (!raw.albedo.empty()) options.albedo = cli::parse_color(raw.albedo, "--albedo");
    if (raw.floor) {
        options.floor.emplace().num_vertices = raw.floor_vertices;
        if (!raw.floor_albedo.empty()) {
            options.floor->albedo = cli::parse_color(raw.floor_albedo, "--floor-albedo");
        }
    }
    if (!raw.transfer_error.empty()) {
        options.bake.transfer_error = cli::parse_fraction(raw.transfer_error, "--transfer-error");
        if (!(options.bake.transfer_error > 0.0 && options.bake.transfer_error < 1.0)) {
            throw_usage(
                "--transfer-error: expected more than 0 and less than 1 (or 100%), got '{}'",
                raw.transfer_error);
        }
        options.bake.rays = kMaxRays;
    }
    if (raw.rays) options.bake.rays = *raw.rays;
    options.bake.sampler = kind_of(raw.sampler, kSamplerKinds, &sampler_name);
    options.bake.streams = kind_of(raw.streams, kStreams, &streams_name);
    if (options.bake.rays % 2 != 0) {
        throw_usage("--rays: expected an even number (two independent halves), got {}",
                    options.bake.rays);
    }
    options.encode.geometry = parse_components(raw.geometry_components, "--geometry-components");
    options.encode.transfer = parse_components(raw.transfer_components, "--transfer-components");
    options.encode.automatic_transfer_error =
        cli::parse_fraction(raw.auto_transfer_error, "--auto-transfer-error");
    options.encode.memory_bytes = cli::parse_bytes(raw.memory, "--memory");
    if (options.encode.memory_bytes < kMinMemoryBytes) {
        throw_usage("--memory: expected at least 64M, got '{}'", raw.memory);
    }
    options.encode.noise = raw.noise == "keep" ? NoiseTreatment::keep : NoiseTreatment::shrink;
    options.target = parse_target(raw.target);
    const RawOptions defaults;
    const auto needs_no_target = [&](const char* option, const std::string& value,
                                     const std::string& without) {
        if (options.target && value != without) {
            throw_usage("{}: does not go with --max-error and --max-size, which choose", option);
        }
    };
    needs_no_target("--geometry-components", raw.geometry_components, defaults.geometry_components);
    needs_no_target("--transfer-components", raw.transfer_components, defaults.transfer_components);
    needs_no_target("--auto-transfer-error", raw.auto_transfer_error, defaults.auto_transfer_error);
    options.band_power = raw.target.band_power;
    options.encode.precision = raw.precision == "f16" ? Precision::f16 : Precision::f32;
    if (options.target && options.target->codec == CodecChoice::cpca && raw.precision != "auto") {
        throw_usage("--codec cpca: goes with --precision auto, floats are coded as svd");
    }
    if (options.target && raw.precision == "auto") options.encode.precision = Precision::i16;
    if (raw.encode_bands > 0) options.encode.bands = raw.encode_bands;
}

}  // namespace

std::optional<CompressOptions> parse_options(int argc, const char* const* argv, int& exit_code) {
    CompressOptions options;
    RawOptions raw;
    CLI::App app(
        "Bakes radiance transfer of a pose sequence and compresses it.\n\n"
        "  paim-compress OBJ... -o X.paim         bake and encode in one go\n"
        "  paim-compress bake OBJ... -o X.bake    bake only: long, resumable\n"
        "  paim-compress encode X.bake -o X.paim  encode only: quick, repeat with other settings\n",
        "paim-compress");
    app.set_version_flag("--version", cli::version_text("paim-compress"));
    app.require_subcommand(0, 1);
    app.footer(
        "In one go, the bake is kept beside the output as X.bake, where a killed run goes on; "
        "--discard-bake\nremoves it at the end.\n"
        "Exit codes: 0 ok, 1 usage, 2 bad input, 3 unsupported, 4 output failed,\n5 the error "
        "asked for cannot be met.");
    const std::string bands_help = fmt::format(
        "Spherical-harmonic bands, 1 to {}; B bands are B*B coefficients", sh::kMaxBands);
    const auto bands_range = cli::in_range(1, static_cast<int>(sh::kMaxBands));

    // The one-go form has the options of both; its output is required only where it is meant.
    add_input_options(app, options);
    add_bake_options(app, options, raw);
    app.add_option("--bands", options.bake.bands, bands_help)
        ->check(bands_range)
        ->capture_default_str();
    add_encode_options(app, options, raw);
    app.add_flag("--discard-bake", options.discard_bake, "Remove the bake once it is encoded");
    add_common_options(app, options, "The .paim file to write");
    app.get_option("--output")->required(false);

    CLI::App* bake = app.add_subcommand("bake", "Bake a pose sequence into a .bake directory");
    bake->footer(
        "What is odd about the mesh (open edges, faces that are there twice, ...) is counted in "
        "warnings and in\n--json as 'mesh'. Meshes far from the world's origin are baked near it; "
        "the bake keeps where they were.");
    add_input_options(*bake, options);
    bake->get_option("OBJ")->required();
    add_bake_options(*bake, options, raw);
    bake->add_option("--bands", options.bake.bands, bands_help)
        ->check(bands_range)
        ->capture_default_str();
    bake->add_option("--poses", options.poses,
                     "Bake only poses A-B (counted from 0), so that several processes can share a "
                     "bake; default: all");
    add_common_options(*bake, options, "The .bake directory to write, or to go on with");

    CLI::App* encode = app.add_subcommand("encode", "Encode a .bake directory as a .paim file");
    encode->add_option("BAKE", options.bake_directory, "The .bake directory")->required();
    encode
        ->add_option("--bands", raw.encode_bands,
                     "Bands to keep; more than the bake has are all of them, the default")
        ->check(bands_range);
    add_encode_options(*encode, options, raw);
    add_common_options(*encode, options, "The .paim file to write");

    exit_code = cli::parse(app, argc, argv);
    if (exit_code >= 0) return std::nullopt;
    if (bake->parsed()) options.command = CompressOptions::Command::bake;
    if (encode->parsed()) options.command = CompressOptions::Command::encode;
    if (options.command != CompressOptions::Command::bake_and_encode) {
        for (const CLI::Option* option : app.get_options()) {
            if (option->count() == 0) continue;
            throw_usage("{}: goes after '{}', not before it", option->get_name(),
                        bake->parsed() ? "bake" : "encode");
        }
    } else {
        if (options.inputs.empty()) throw_usage("no OBJ files given; see --help");
        if (options.output.empty()) throw_usage("--output is required; see --help");
    }
    if (options.command != CompressOptions::Command::bake &&
        options.output.extension() != ".paim") {
        throw_usage("--output: expected a name that ends in .paim, got '{}'",
                    options.output.string());
    }
    apply(raw, options);
    return options;
}

std::pair<uint32_t, uint32_t> parse_pose_range(const std::string& text, uint32_t num_poses) {
    if (text.empty()) return {0, num_poses - 1};
    uint32_t first = 0;
    const char* end = text.data() + text.size();
    auto [rest, failure] = std::from_chars(text.data(), end, first);
    uint32_t last = first;
    if (failure == std::errc() && rest != end && *rest == '-') {
        const auto parsed = std::from_chars(rest + 1, end, last);
        rest = parsed.ptr;
        failure = parsed.ec;
    }
    if (failure != std::errc() || rest != end || first > last || last >= num_poses) {
        throw_usage("--poses: expected A-B with 0 <= A <= B <= {}, got '{}'", num_poses - 1, text);
    }
    return {first, last};
}

}  // namespace paim
