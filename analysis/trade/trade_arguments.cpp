// The options of a sweep on the command line.
#include "analysis/trade/trade_arguments.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <vector>

#include "analysis/trade/grid.h"
#include "paim/base/error.h"
#include "paim/cli/parse.h"
#include "paim/sh/index.h"

namespace paim {

namespace {

constexpr const char* kGroup = "Cost against error";
constexpr uint32_t kMostSweepRays = 65536;

std::vector<std::string> parts_of(const std::string& list) {
    std::vector<std::string> parts;
    size_t begin = 0;
    while (true) {
        const size_t comma = list.find(',', begin);
        parts.push_back(list.substr(begin, comma - begin));
        if (comma == std::string::npos) return parts;
        begin = comma + 1;
    }
}

std::vector<std::string> parse_errors(const std::string& list) {
    std::vector<std::string> errors = parts_of(list);
    for (const std::string& error : errors) cli::parse_share(error, "--sweep-errors");
    return errors;
}

std::vector<Precision> parse_precisions(const std::string& list) {
    std::vector<Precision> precisions;
    for (const std::string& part : parts_of(list)) {
        const auto found = std::find_if(
            kSweepPrecisions.begin(), kSweepPrecisions.end(),
            [&](Precision precision) { return part == sweep_precision_name(precision); });
        if (found == kSweepPrecisions.end()) {
            throw_usage(
                "--sweep-precision: expected integers, f16 or f32, separated by commas, got '{}'",
                list);
        }
        if (std::find(precisions.begin(), precisions.end(), *found) == precisions.end()) {
            precisions.push_back(*found);
        }
    }
    return precisions;
}

std::optional<TradeLimit> limit_of(const TradeArguments& arguments) {
    if (arguments.target) {
        return TradeLimit{TradeLimit::Of::error, cli::parse_share(*arguments.target, "--target")};
    }
    if (arguments.target_size) {
        return TradeLimit{TradeLimit::Of::bytes, static_cast<double>(cli::parse_bytes(
                                                     *arguments.target_size, "--target-size"))};
    }
    if (arguments.target_cost) {
        return TradeLimit{TradeLimit::Of::multiply_adds,
                          static_cast<double>(*arguments.target_cost)};
    }
    return std::nullopt;
}

}  // namespace

void add_trade_options(CLI::App& app, TradeArguments& arguments) {
    app.add_flag("--sweep", arguments.sweep,
                 "Encode the bake in many ways, with several numbers of bands, errors, codecs and "
                 "preferences, and measure each file: its bytes, its multiply-adds, its errors and "
                 "what is seen of them. Writes trade.csv and trade.json. Any option of this group "
                 "implies it")
        ->group(kGroup);
    CLI::Option* const target =
        app.add_option(
               "--target", arguments.target,
               "Largest visual error (E6, under the worst of the lights), such as 1%: the "
               "command line of the smallest file within it is printed, and of the one that "
               "is cheapest to play, with files between those of the sweep where they are "
               "better. Exit code 5 if no file is within it")
            ->type_name("ERROR")
            ->group(kGroup);
    CLI::Option* const target_size =
        app.add_option("--target-size", arguments.target_size,
                       "Most bytes of a file, such as 300K or 2M: the same for the file with the "
                       "smallest visual error")
            ->type_name("SIZE")
            ->group(kGroup)
            ->excludes(target);
    app.add_option("--target-cost", arguments.target_cost,
                   "Most multiply-adds per vertex and frame for the lit transfer, 1 to 1000000: "
                   "the same for the file with the smallest visual error")
        ->check(cli::in_range(1u, 1'000'000u))
        ->type_name("N")
        ->group(kGroup)
        ->excludes(target)
        ->excludes(target_size);
    app.add_option("--sweep-bands", arguments.bands,
                   fmt::format("Numbers of bands, separated by commas, 1 to {}; those above the "
                               "bake's are left out. Default: all from {} to the bake's",
                               sh::kMaxBands, kFewestUsualBands))
        ->type_name("LIST")
        ->group(kGroup);
    app.add_option("--sweep-rays", arguments.rays,
                   fmt::format("Rays a vertex of further bakes of the same poses, even numbers "
                               "separated by commas, 2 to {}: they are made for the sweep in the "
                               "output directory, and removed. Default: the given bake alone",
                               kMostSweepRays))
        ->type_name("LIST")
        ->group(kGroup);
    app.add_option(
           "--sweep-errors", arguments.errors,
           fmt::format(
               "Errors of the transfer to encode to (--max-error of paim-compress), "
               "separated by commas; those that the bake cannot reach are left "
               "out. Floats are cut at the same errors (--auto-transfer-error). Default: {}; "
               "floats: {}",
               fmt::join(usual_errors(), ","), usual_plain_error()))
        ->type_name("LIST")
        ->group(kGroup);
    app.add_option(
           "--sweep-precision", arguments.precisions,
           "How values are stored, separated by commas. 'integers': with the steps that meet "
           "--sweep-errors. 'f16', 'f32': floats without a target, as in the paper, once with all "
           "components and once cut at each error. Default: integers,f16,f32")
        ->type_name("LIST")
        ->group(kGroup);
}

std::optional<TradeOptions> trade_options(const TradeArguments& arguments) {
    TradeOptions options;
    options.limit = limit_of(arguments);
    if (arguments.bands) {
        options.bands = cli::parse_list(*arguments.bands, "--sweep-bands", 1, sh::kMaxBands);
    }
    if (arguments.rays) {
        options.rays = cli::parse_list(*arguments.rays, "--sweep-rays", 2, kMostSweepRays, 2);
    }
    if (arguments.errors) options.errors = parse_errors(*arguments.errors);
    if (arguments.precisions) options.precisions = parse_precisions(*arguments.precisions);
    const bool wanted = arguments.sweep || !options.precisions.empty() || options.limit ||
                        !options.bands.empty() || !options.errors.empty() || !options.rays.empty();
    if (!wanted) return std::nullopt;
    return options;
}

}  // namespace paim
