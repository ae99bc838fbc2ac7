// The encode options of paim-compress.
#include "compressor/encode_arguments.h"

#include <fmt/format.h>

#include <charconv>
#include <vector>

#include "compressor/encode/search/transfer_encoder.h"
#include "paim/base/error.h"
#include "paim/cli/light_options.h"
#include "paim/cli/parse.h"

namespace paim {

namespace {

constexpr uint64_t kMinMemoryBytes = 64'000'000;

// What `text_of` says of each encoder, with `between` them.
template <typename TextOf>
std::string of_encoders(const char* between, const TextOf& text_of) {
    std::string text;
    for (const TransferEncoderType& type : transfer_encoders()) {
        const std::string one = text_of(type);
        if (!text.empty() && !one.empty()) text += between;
        text += one;
    }
    return text;
}

// Names of the codecs that code floats.
std::string codecs_of_floats() {
    return of_encoders(" or ", [](const TransferEncoderType& type) {
        return type.codes_floats ? std::string(type.codec) : "";
    });
}

void add_codec_options(CLI::App& app, EncodeArguments& arguments, const char* group) {
    const std::string costs = of_encoders("; ", [](const TransferEncoderType& type) {
        return fmt::format("with {}, {}", type.codec, type.words.cost);
    });
    app.add_option(
           "--max-decode-cost", arguments.max_decode_cost,
           "Largest number of multiply-adds per vertex and frame for the lit transfer: " + costs)
        ->type_name("N")
        ->group(group);
    std::vector<std::string> names{"auto"};
    for (const TransferEncoderType& type : transfer_encoders()) names.emplace_back(type.codec);
    const std::string codecs = of_encoders(", ", [](const TransferEncoderType& type) {
        return fmt::format("'{}' ({})", type.codec, type.words.description);
    });
    cli::add_choice(app, "--codec", arguments.codec, names,
                    fmt::format("Coding of the transfer: {}, or 'auto', the better one for the "
                                "target",
                                codecs))
        ->group(group);
}

void add_target_options(CLI::App& app, CompressOptions& options, EncodeArguments& arguments) {
    constexpr const char* kGroup = "With --max-error or --max-size";
    app.add_option(
           "--max-vertex-error", arguments.max_vertex_error,
           "Largest error of a vertex to the bake over all poses, as a share of the RMS over "
           "vertices, such as 10%. The error of the transfer is made smaller until the "
           "worst vertex meets it, which takes several searches. Default: any")
        ->type_name("ERROR")
        ->group(kGroup);
    app.add_option(
           "--max-gloss-error", arguments.max_gloss_error,
           "Largest error of glossy transfer, relative to it, such as 10%. Without it, that "
           "of --max-error")
        ->type_name("ERROR")
        ->group(kGroup);
    app.add_option("--geometry-error", arguments.geometry_error,
                   fmt::format("Largest RMS distance of the positions, as a share of the diagonal "
                               "of the largest pose. Where integers of 16 bits cannot be that "
                               "good, positions are floats. Default: the error of the transfer / "
                               "{:g}",
                               1.0 / kGeometryPerTransferError))
        ->type_name("ERROR")
        ->group(kGroup);
    app.add_option("--max-sted", arguments.max_sted,
                   fmt::format("Largest STED of the positions: by how much edges differ in length "
                               "where their neighbours do not, and steps from pose to pose. It "
                               "holds for each piece of the mesh. Default: the geometry error "
                               "times {:g}, at most {:g} %",
                               kStedPerGeometryError, 100.0 * kLargestSted))
        ->type_name("ERROR")
        ->group(kGroup);
    app.add_option("--max-normal-angle", arguments.max_normal_angle,
                   fmt::format("Largest mean angle by which face normals turn, degrees, above 0. "
                               "It holds for each piece of the mesh. Default: the geometry error "
                               "in percent times {:g}, at most {:g}",
                               0.01 * kNormalDegreesPerGeometryError, kLargestNormalAngle_deg))
        ->check(cli::in_range(1e-6, 180.0))
        ->type_name("DEGREES")
        ->group(kGroup);
    add_codec_options(app, arguments, kGroup);
    cli::add_choice<Preference>(
        app, "--prefer", arguments.preference,
        {{"size", Preference::size}, {"speed", Preference::speed}},
        "Of the files that meet the target, the smallest or the cheapest to play")
        ->group(kGroup);
    app.add_option("--light-spectrum", options.band_power,
                   "The light that errors are weighted by: 'flat' (the same power in every band), "
                   "'natural' (less in high bands), or that of an environment map (EXR)")
        ->capture_default_str()
        ->type_name("LIGHT")
        ->group(kGroup);
    cli::add_env_mapping(app, options.env_mapping)->group(kGroup);
}

void add_component_options(CLI::App& app, CompressOptions& options, EncodeArguments& arguments) {
    constexpr const char* kGroup = "Without --max-error and --max-size";
    app.add_option("--transfer-components", arguments.transfer_components,
                   "Components of the transfer: a number, 'all' or 'auto'")
        ->capture_default_str()
        ->type_name("K")
        ->group(kGroup);
    app.add_option("--geometry-components", arguments.geometry_components,
                   "Components of the geometry: a number, 'all' or 'auto' (for an error of 1 % and "
                   "every vertex's motion)")
        ->capture_default_str()
        ->type_name("K")
        ->group(kGroup);
    app.add_option("--auto-transfer-error", arguments.auto_transfer_error,
                   "Error that 'auto' allows the transfer, not counting the noise of the bake. "
                   "Components of nothing but noise are never kept")
        ->capture_default_str()
        ->type_name("ERROR")
        ->group(kGroup);
    app.add_flag("--measure", options.encode.measure,
                 "Measure the file and state its errors in it, as is always done with a target. "
                 "Needs the memory for the whole file")
        ->group(kGroup);
}

void add_storage_options(CLI::App& app, CompressOptions& options, EncodeArguments& arguments) {
    constexpr const char* kGroup = "Noise and numbers";
    cli::add_choice<NoiseTreatment>(
        app, "--noise", options.encode.noise,
        {{"shrink", NoiseTreatment::shrink}, {"keep", NoiseTreatment::keep}},
        "Noise of the bake in the components: 'shrink' scales each one down by its share of "
        "noise, 'keep' leaves it. With 'all' components it is always left")
        ->group(kGroup);
    cli::add_choice<PrecisionChoice>(
        app, "--precision", arguments.precision,
        {{"auto", PrecisionChoice::automatic},
         {"f32", PrecisionChoice::f32},
         {"f16", PrecisionChoice::f16}},
        fmt::format(
            "Numbers in the file: 'f32', 'f16' (half the size), or 'auto' (integers if there is a "
            "target, else f32). Floats are always coded as {}",
            codecs_of_floats()))
        ->group(kGroup);
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

// The options that need a target must have their defaults without one.
void check_without_target(const EncodeArguments& arguments, const CompressOptions& options) {
    const auto needs_target = [](bool given, const char* option) {
        if (given) throw_usage("{}: needs --max-error or --max-size", option);
    };
    needs_target(!arguments.max_vertex_error.empty(), "--max-vertex-error");
    needs_target(!arguments.max_gloss_error.empty(), "--max-gloss-error");
    needs_target(!arguments.geometry_error.empty(), "--geometry-error");
    needs_target(!arguments.max_sted.empty(), "--max-sted");
    needs_target(arguments.max_normal_angle.has_value(), "--max-normal-angle");
    needs_target(arguments.max_decode_cost.has_value(), "--max-decode-cost");
    needs_target(arguments.codec != EncodeArguments().codec, "--codec");
    needs_target(arguments.preference != Preference::size, "--prefer");
    needs_target(options.band_power != CompressOptions().band_power, "--light-spectrum");
    needs_target(options.env_mapping != EnvMapping::automatic, "--env-mapping");
}

// The options that a target decides must have their defaults with one.
void check_with_target(const EncodeArguments& arguments) {
    const EncodeArguments defaults;
    const auto decided = [](const std::string& value, const std::string& without,
                            const char* option) {
        if (value == without) return;
        throw_usage("{}: cannot be set together with --max-error or --max-size, which decide it",
                    option);
    };
    decided(arguments.geometry_components, defaults.geometry_components, "--geometry-components");
    decided(arguments.transfer_components, defaults.transfer_components, "--transfer-components");
    decided(arguments.auto_transfer_error, defaults.auto_transfer_error, "--auto-transfer-error");
}

// The target without its band power, which depends on the bands of the bake.
EncodeTarget parse_target(const EncodeArguments& arguments) {
    EncodeTarget target;
    if (!arguments.max_error.empty()) {
        target.transfer_error = cli::parse_share(arguments.max_error, "--max-error");
    }
    if (!arguments.max_vertex_error.empty()) {
        target.vertex_error = cli::parse_share(arguments.max_vertex_error, "--max-vertex-error");
    }
    if (!arguments.geometry_error.empty()) {
        target.geometry_error = cli::parse_share(arguments.geometry_error, "--geometry-error");
    }
    if (!arguments.max_sted.empty()) {
        target.sted = cli::parse_share(arguments.max_sted, "--max-sted");
    }
    target.normal_angle_deg = arguments.max_normal_angle;
    if (!arguments.max_size.empty()) {
        target.size_bytes = cli::parse_bytes(arguments.max_size, "--max-size");
    }
    target.decode_cost = arguments.max_decode_cost;
    target.codec = arguments.codec;
    target.preference = arguments.preference;
    return target;
}

Precision precision_of(PrecisionChoice choice, bool has_target) {
    switch (choice) {
        case PrecisionChoice::f32:
            return Precision::f32;
        case PrecisionChoice::f16:
            return Precision::f16;
        case PrecisionChoice::automatic:
            break;
    }
    return has_target ? Precision::i16 : Precision::f32;
}

}  // namespace

void add_everyday_encode_options(CLI::App& app, CompressOptions& options,
                                 EncodeArguments& arguments) {
    app.add_option("--max-error", arguments.max_error,
                   "Largest error of the transfer, and of the gloss by itself, such as 5%. The "
                   "smallest file that meets it is found, measured and written (docs/metrics.md)")
        ->type_name("ERROR");
    app.add_option("--max-size", arguments.max_size,
                   "Largest size of the file, such as 300K or 2M. The file with the smallest error "
                   "that fits, at most 50%, is written. With --max-error, both are met")
        ->type_name("SIZE");
    app.add_option("--fps", options.encode.frames_per_second,
                   "Poses per second when the animation plays, 0.001 to 1000000")
        ->check(cli::in_range(1e-3, 1e6))
        ->capture_default_str()
        ->type_name("N");
}

void add_encode_options(CLI::App& app, CompressOptions& options, EncodeArguments& arguments) {
    add_target_options(app, options, arguments);
    add_component_options(app, options, arguments);
    add_storage_options(app, options, arguments);
    app.add_option("--memory", arguments.memory,
                   "Memory that encoding may take, such as 512M or 4G, at least 64M. The result "
                   "does not depend on it")
        ->capture_default_str()
        ->type_name("SIZE")
        ->group(kRunningGroup);
}

void apply(const EncodeArguments& arguments, CompressOptions& options) {
    options.encode.geometry =
        parse_components(arguments.geometry_components, "--geometry-components");
    options.encode.transfer =
        parse_components(arguments.transfer_components, "--transfer-components");
    options.encode.automatic_transfer_error =
        cli::parse_fraction(arguments.auto_transfer_error, "--auto-transfer-error");
    options.encode.memory_bytes = cli::parse_bytes(arguments.memory, "--memory");
    if (options.encode.memory_bytes < kMinMemoryBytes) {
        throw_usage("--memory: expected at least 64M, got '{}'", arguments.memory);
    }
    if (arguments.has_target()) {
        options.target = parse_target(arguments);
        check_with_target(arguments);
        if (!arguments.max_gloss_error.empty()) {
            if (!options.target->transfer_error) {
                throw_usage("--max-gloss-error: needs --max-error");
            }
            options.gloss_error = cli::parse_share(arguments.max_gloss_error, "--max-gloss-error");
        }
    } else {
        check_without_target(arguments, options);
    }
    options.encode.precision = precision_of(arguments.precision, arguments.has_target());
    if (options.target) encoders_to_try(options.target->codec, options.encode.precision);  // checks
}

}  // namespace paim
