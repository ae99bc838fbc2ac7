// paim-info: describes a .paim file, a .bake directory or an environment map.
#include <fmt/format.h>

#include <optional>

#include "analysis/info/describe.h"
#include "analysis/info/describe_light.h"
#include "analysis/info/prefix_table.h"
#include "paim/base/error.h"
#include "paim/base/json_text.h"
#include "paim/cli/light_options.h"
#include "paim/cli/run_main.h"
#include "paim/image/exr_header.h"
#include "paim/sh/index.h"

namespace {

constexpr int kDefaultBands = 3;

struct InfoOptions {
    std::filesystem::path path;
    bool json = false, prefixes = false;
    std::optional<int> bands;
    paim::EnvMapping mapping = paim::EnvMapping::automatic;
};

// Returns an exit code where there is nothing more to do, or -1.
int parse_info(int argc, char** argv, InfoOptions& options) {
    CLI::App app(
        "Checks a .paim file, a .bake directory or an environment map and says what it holds.",
        "paim-info");
    app.set_version_flag("--version", paim::cli::version_text("paim-info"));
    app.footer("Exit codes: 0 ok, 1 usage, 2 missing or damaged, 3 unsupported.");
    app.add_option("FILE", options.path,
                   "A .paim file, a .bake directory or an environment map (OpenEXR)")
        ->required();
    app.add_flag("--prefixes", options.prefixes,
                 "List what can be played of a .paim before it is read whole: bytes, "
                 "components and errors");
    app.add_option("--bands", options.bands,
                   fmt::format("Bands of an environment map whose spherical-harmonic coefficients "
                               "are listed, 1 to {}; B bands are B*B coefficients a channel "
                               "(default: {})",
                               paim::sh::kMaxBands, kDefaultBands))
        ->check(paim::cli::in_range(1, static_cast<int>(paim::sh::kMaxBands)));
    paim::cli::add_env_mapping(app, options.mapping);
    app.add_flag("--json", options.json, "Write one JSON object on stdout and nothing else");
    return paim::cli::parse(app, argc, argv);
}

// The description as JSON, and the words that turn it into text.
void print_description(const InfoOptions& options) {
    // Missing or damaged maps are named as such.
    const bool light = options.path.extension() == ".exr" || paim::is_exr(options.path);
    if (light && options.prefixes) {
        paim::throw_usage("--prefixes: expected a .paim file, {} is an environment map",
                          options.path.string());
    }
    if (!light && (options.bands || options.mapping != paim::EnvMapping::automatic)) {
        paim::throw_usage("{}: expected an environment map (OpenEXR), {} is none",
                          options.bands ? "--bands" : "--env-mapping", options.path.string());
    }
    const auto description = light ? paim::describe_light(options.path, options.mapping,
                                                          options.bands.value_or(kDefaultBands))
                             : options.prefixes ? paim::describe_prefixes(options.path)
                                                : paim::describe(options.path);
    fmt::print("{}", options.json       ? paim::json_text(description, 2) + "\n"
                     : light            ? paim::light_as_text(description)
                     : options.prefixes ? paim::prefixes_as_text(description)
                                        : paim::as_text(description));
}

}  // namespace

int main(int argc, char** argv) {
    return paim::cli::run_main("paim-info", [&] {
        InfoOptions options;
        if (const int code = parse_info(argc, argv, options); code >= 0) return code;
        print_description(options);
        return 0;
    });
}
