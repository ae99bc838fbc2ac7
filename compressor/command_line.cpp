// The command line of paim-compress.
#include "compressor/command_line.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <limits>

#include "compressor/bake_arguments.h"
#include "compressor/encode_arguments.h"
#include "paim/base/error.h"
#include "paim/cli/parse.h"
#include "paim/sh/index.h"

namespace paim {

namespace {

// The commands and where the values of their options go.
struct CommandLine {
    CompressOptions options;
    BakeArguments bake_arguments;
    EncodeArguments encode_arguments;
    CLI::App app;
    CLI::App* bake = nullptr;
    CLI::App* encode = nullptr;

    CommandLine();
    void define_both();
    void define_bake();
    void define_encode();

    // Error (usage) for options in the wrong place and for names that do not fit.
    void check_usage() const;
};

void add_output(CLI::App& app, CompressOptions& options, const std::string& help) {
    app.add_option("-o,--output", options.output, help)->required()->type_name("FILE");
}

void add_running_options(CLI::App& app, CompressOptions& options) {
    app.add_option("--threads", options.num_threads,
                   "Threads, 0 to 1024; 0 uses every core. The result does not depend on it")
        ->check(cli::in_range(0, 1024))
        ->capture_default_str()
        ->type_name("N")
        ->group(kRunningGroup);
    app.add_flag("--json", options.json, "Print one JSON object on stdout and nothing else")
        ->group(kRunningGroup);
    app.add_flag("--quiet", options.quiet, "Show no progress")->group(kRunningGroup);
}

CommandLine::CommandLine()
    : app("Bakes the radiance transfer of a pose sequence and compresses it.\n\n"
          "  paim-compress OBJ... -o X.paim         bake and encode in one go\n"
          "  paim-compress bake OBJ... -o X.bake    bake only: long, can be resumed\n"
          "  paim-compress encode X.bake -o X.paim  encode only: quick, repeat with other settings\n",
          "paim-compress") {
    app.set_version_flag("--version", cli::version_text("paim-compress"));
    app.require_subcommand(0, 1);
    app.footer(
        "Example: paim-compress 'frames/*.obj' -o character.paim --max-error 5%\n"
        "The bake stays next to the output as character.bake, and a run that was stopped goes on\n"
        "from there.\n\n"
        "Exit codes: 0 ok, 1 usage, 2 bad input, 3 unsupported, 4 output failed,\n"
        "5 the target cannot be met.");
    define_both();
    define_bake();
    define_encode();
}

void CommandLine::define_both() {
    add_output(app, options, "The .paim file to write");
    app.get_option("--output")->required(false);  // only where no command is given
    add_everyday_encode_options(app, options, encode_arguments);
    add_everyday_bake_options(app, options, bake_arguments);
    CLI::Option* const rays = app.get_option("--rays");
    rays->description(rays->get_description() +
                      ". With --max-error the default is as few as meet it, which a short bake "
                      "finds out");
    add_bake_options(app, options, bake_arguments);
    add_encode_options(app, options, encode_arguments);
    app.add_flag("--discard-bake", options.discard_bake, "Remove the bake once the file is written")
        ->group(kRunningGroup);
    add_running_options(app, options);
}

void CommandLine::define_bake() {
    bake = app.add_subcommand("bake", "Bakes a pose sequence into a .bake directory");
    bake->footer(
        "Example: paim-compress bake frames/ -o character.bake --bands 7 --rays 1024 --floor\n"
        "The same command goes on with a bake that was stopped. Open edges, duplicate faces and\n"
        "other oddities of the mesh are counted in warnings and, with --json, in 'mesh'.");
    add_output(*bake, options, "The .bake directory to write, or to go on with");
    add_everyday_bake_options(*bake, options, bake_arguments);
    bake->get_option("OBJ")->required();
    bake->add_option("--poses", options.poses,
                     "Bake only poses A to B, counted from 0, so that several processes can share "
                     "a bake. Default: all")
        ->type_name("A-B");
    add_bake_options(*bake, options, bake_arguments);
    add_running_options(*bake, options);
}

void CommandLine::define_encode() {
    encode = app.add_subcommand("encode", "Encodes a .bake directory as a .paim file");
    encode->footer(
        "Example: paim-compress encode character.bake -o character.paim --max-error 5%\n"
        "Exit code 5 says that the target cannot be met; the message names the best that can.");
    encode->add_option("BAKE", options.bake_directory, "The .bake directory")
        ->required()
        ->type_name("");
    add_output(*encode, options, "The .paim file to write");
    add_everyday_encode_options(*encode, options, encode_arguments);
    encode
        ->add_option("--bands", options.encode.bands,
                     fmt::format("Bands to keep, 1 to {}. Default: all of the bake", sh::kMaxBands))
        ->check(cli::in_range(1, static_cast<int>(sh::kMaxBands)))
        ->type_name("B");
    add_encode_options(*encode, options, encode_arguments);
    encode
        ->add_flag_callback(
            "--no-textures", [this] { options.encode.textures = false; },
            "Leave the images of the bake out of the file. Light that they bounced stays")
        ->group("Textures");
    add_running_options(*encode, options);
}

void CommandLine::check_usage() const {
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
    const bool is_paim = options.output.extension() == ".paim";
    if (options.command == CompressOptions::Command::bake) {
        if (is_paim) {
            throw_usage("--output: expected a directory such as {}, got '{}'",
                        std::filesystem::path(options.output).replace_extension(".bake").string(),
                        options.output.string());
        }
    } else if (!is_paim) {
        throw_usage("--output: expected a name that ends in .paim, got '{}'",
                    options.output.string());
    }
}

}  // namespace

std::optional<CompressOptions> parse_options(int argc, const char* const* argv, int& exit_code) {
    CommandLine line;
    exit_code = cli::parse(line.app, argc, argv);
    if (exit_code >= 0) return std::nullopt;
    if (line.bake->parsed()) line.options.command = CompressOptions::Command::bake;
    if (line.encode->parsed()) line.options.command = CompressOptions::Command::encode;
    line.check_usage();
    apply(line.bake_arguments, line.options);
    apply(line.encode_arguments, line.options);
    line.options.chooses_rays = line.options.command == CompressOptions::Command::bake_and_encode &&
                                line.options.target && line.options.target->transfer_error &&
                                !line.bake_arguments.rays &&
                                line.options.bake.transfer_error == 0.0;
    return std::move(line.options);
}

}  // namespace paim
