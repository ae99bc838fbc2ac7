// The steps of paim-analyze.
#include "analysis/analyze.h"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include <cmath>
#include <limits>

#include "analysis/csv.h"
#include "analysis/curves.h"
#include "analysis/measure.h"
#include "analysis/plots.h"
#include "analysis/report.h"
#include "analysis/stage.h"
#include "analysis/trade/seen_error.h"
#include "compressor/encode/encode.h"
#include "paim/base/error.h"
#include "paim/base/file.h"
#include "paim/base/json_text.h"
#include "paim/base/tbb_parallel.h"
#include "paim/cli/progress.h"
#include "paim/format/paim/paim_read.h"
#include "paim/format/paim/paim_write.h"

namespace paim {

namespace {

// Encodes all components as f32, by the encoder and the file format of the tools.
Asset encode_everything(const BakeReader& bake, const std::filesystem::path& directory) {
    struct Remover {
        std::filesystem::path path;
        ~Remover() {
            std::error_code ignored;
            std::filesystem::remove(path, ignored);
        }
    };
    const Remover file{directory / "all-components.paim.tmp"};
    EncodeOptions options;
    options.geometry.kind = ComponentChoice::Kind::all;
    options.transfer.kind = ComponentChoice::Kind::all;
    options.name = bake.directory().stem().string();
    // No limit: afterwards the whole file is read into memory, which takes far more.
    options.memory_bytes = std::numeric_limits<uint64_t>::max();
    encode(bake, options, file.path);
    return read_paim(file.path);
}

// Error if the images of the report, which are kept until it is written, do not fit into memory.
void check_memory(const AnalyzeOptions& options, size_t num_images) {
    constexpr double kMaxGigabytes = 4.0;
    const double size = options.size_pixels;
    const double gigabytes = 1e-9 * sizeof(Vec3f) * size * size * static_cast<double>(num_images);
    if (gigabytes > kMaxGigabytes) {
        throw_usage(
            "--size {}: {} images would take {:.1f} GB, expected at most {:g}; measure fewer "
            "settings or lights, or smaller images",
            options.size_pixels, num_images, gigabytes, kMaxGigabytes);
    }
}

nlohmann::ordered_json curve_json(const Curve& curve, const std::vector<NamedLight>& lights) {
    auto points = nlohmann::ordered_json::array();
    for (const CurvePoint& point : curve.points) {
        nlohmann::ordered_json json;
        json["kept"] = point.value;
        json["all"] = point.all;
        json["theory_error"] = point.theory_error;
        json["energy_error"] = point.energy_error;
        for (size_t light = 0; light < lights.size(); ++light) {
            json["visual_error"][lights[light].name] = point.visual_error[light];
        }
        json["position_rms"] = point.distance.rms();
        json["position_worst"] = {{"distance", point.distance.worst},
                                  {"vertex", point.distance.worst_vertex},
                                  {"pose", point.distance.worst_pose}};
        json["transfer_error"] = point.transfer.relative();
        json["size_bytes"] = point.size_bytes;
        json["decode_ms"] = point.decode_ms;
        points.push_back(std::move(json));
    }
    return points;
}

// On stderr, for each light under which nothing was to be seen.
void say_what_was_not_measured(const std::vector<Curve>& curves,
                               const std::vector<NamedLight>& lights) {
    for (size_t light = 0; light < lights.size(); ++light) {
        if (!std::isnan(curves.front().points.front().visual_error[light])) continue;
        fmt::print(stderr,
                   "paim-analyze: note: light {}: {}; no visual error was measured (nan in CSV, "
                   "null in JSON)\n",
                   lights[light].name, why_nothing_is_seen(lights[light]));
    }
}

}  // namespace

void analyze(const AnalyzeOptions& options) {
    const ThreadLimit limit(options.num_threads);
    const bool quiet = options.quiet || options.json;
    const BakeReader bake(options.bake_directory);
    if (is_bake(options.output)) {
        throw_usage("--output {}: is a bake, expected another directory", options.output.string());
    }
    const std::vector<NamedLight> lights =
        load_lights(options.environments, options.env_mapping, bake.identity().layout.in_bands);
    const size_t most_settings = 2 * (options.components.size() + 1) + options.bands.size() + 1;
    check_memory(options, most_settings * lights.size());
    const bool with_plots = have_gnuplot();
    if (!with_plots) fmt::print(stderr, "warning: gnuplot is not installed: no SVG curves\n");
    bake.verify_all();  // before anything is written
    ensure_directory(options.output);

    const Asset asset = encode_everything(bake, options.output);
    const Stage stage(bake, lights, options.azimuth_rad, options.elevation_rad, options.size_pixels,
                      options.num_poses);
    std::vector<Curve> curves = plan_curves(bake, asset, options.components, options.bands);
    cli::Progress progress("measuring", "images", num_points(curves) * stage.poses().size(), quiet);
    const std::vector<Image> references =
        measure_curves(bake, asset, stage, curves, [&] { progress.advance(); });
    progress.finish();
    say_what_was_not_measured(curves, lights);

    nlohmann::ordered_json json;
    json["directory"] = options.output.string();
    for (const Curve& curve : curves) {
        write_file(options.output / (curve.name + ".csv"), curve_csv(curve, lights));
        if (with_plots) write_plots(options.output, curve, lights);
        json[curve.name] = curve_json(curve, lights);
    }
    const std::string summary = fmt::format(
        "{} vertices, {} triangles, {} poses of which {} are measured, {} bands. Errors are "
        "relative "
        "to the bake itself.",
        bake.identity().num_vertices, bake.identity().num_triangles, bake.num_poses(),
        stage.poses().size(), asset.moving().layout.in_bands);
    write_report(options.output, "Error analysis of " + asset.name, summary, curves, stage,
                 references, with_plots);
    if (options.trade) {
        json["trade"] = run_trade(bake, *options.trade, options.output, play_on_stage(bake, stage),
                                  quiet, options.json);
    }
    if (options.json) {
        fmt::print("{}\n", json_text(json, 2));
    } else {
        fmt::print("{}\n", (options.output / "index.html").string());
    }
}

}  // namespace paim
