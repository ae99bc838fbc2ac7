// The section of error curves.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "analysis/analysis_run.h"
#include "analysis/csv.h"
#include "analysis/curves.h"
#include "analysis/measure.h"
#include "analysis/plots.h"
#include "analysis/report.h"
#include "analysis/scratch_encode.h"
#include "paim/base/file.h"
#include "paim/cli/progress.h"

namespace paim {

namespace {

nlohmann::ordered_json curve_json(const Curve& curve, const std::vector<NamedLight>& lights) {
    auto points = nlohmann::ordered_json::array();
    for (const CurvePoint& point : curve.points) {
        nlohmann::ordered_json json;
        json["kept"] = point.value;
        json["all"] = point.all;
        json["theory_error"] = point.theory_error;
        json["energy_error"] = point.energy_error;
        for (size_t light = 0; light < lights.size(); ++light) {
            const PictureErrors& seen = point.seen[light];
            const PictureErrors::Spread spread = seen.spread();
            const std::string& name = lights[light].name;
            json["visual_error"][name] = seen.visual_error();
            json["visual_error_spread"][name] = {{"least", spread.least},
                                                 {"median", spread.median},
                                                 {"most", spread.most},
                                                 {"deviation", spread.deviation},
                                                 {"worst_pose", spread.worst_pose},
                                                 {"worst_view", spread.worst_view}};
            json["rmse"][name] = seen.all().rmse();
            json["psnr_db"][name] = seen.all().psnr_db();
        }
        json["position_rms"] = point.distance.rms();
        json["position_worst"] = {{"distance", point.distance.worst},
                                  {"vertex", point.distance.worst_vertex},
                                  {"pose", point.distance.worst_pose}};
        json["edge_distortion"] = point.shape.sted_space;
        json["normal_angle_deg"] = point.shape.normal_angle_deg;
        json["transfer_error"] = point.transfer.relative();
        json["size_bytes"] = point.size_bytes;
        json["decode_ms"] = point.decode.median_ms;
        points.push_back(std::move(json));
    }
    return points;
}

// On stderr, for each number that is more than there is.
void say_what_was_left_out(const std::vector<Curve>& curves,
                           const std::vector<uint32_t>& components,
                           const std::vector<uint32_t>& bands) {
    for (const Curve& curve : curves) {
        const bool is_bands = curve.name == "bands";
        const uint32_t all = curve.points.front().value;
        for (const uint32_t wanted : is_bands ? bands : components) {
            if (wanted <= all) continue;
            fmt::print(stderr, "paim-analyze: note: {}: {} asked for, there are {}\n", curve.name,
                       wanted, all);
        }
    }
}

// On stderr, for each light under which nothing was to be seen.
void say_what_was_not_measured(const std::vector<Curve>& curves,
                               const std::vector<NamedLight>& lights) {
    for (size_t light = 0; light < lights.size(); ++light) {
        if (!std::isnan(curves.front().points.front().seen[light].visual_error())) continue;
        fmt::print(stderr,
                   "paim-analyze: note: light {}: {}; no visual error was measured (nan in CSV, "
                   "null in JSON)\n",
                   lights[light].name, why_nothing_is_seen(lights[light]));
    }
}

// On stderr, where the noise of the reference disturbs.
void say_where_noise_is_large(AnalysisRun& run, const std::vector<double>& noise,
                              const std::vector<Curve>& curves) {
    for (size_t light = 0; light < run.stage.lights().size(); ++light) {
        double smallest = std::numeric_limits<double>::infinity();
        for (const Curve& curve : curves) {
            for (const CurvePoint& point : curve.points) {
                smallest = std::min(smallest, point.seen[light].visual_error());
            }
        }
        run.say_if_noise_is_large(light, noise[light], smallest);
    }
}

const std::vector<std::pair<std::string, std::string>> kTerms{
    {"theory", "the share of the singular values that is dropped (E5)"},
    {"energy", "its root-mean-square form, the relative error of what moves"},
    {"seen",
     "the difference of pictures, relative to the reference (E6): over all pictures, and the least and "
     "most of a single one"},
    {"PSNR", "peak signal-to-noise ratio of linear radiance, where the mesh is"},
    {"positions", "distance from the bake's, in scene units"},
    {"edges", "how much edges of a vertex change against each other (the space part of STED)"},
    {"normals", "mean angle between decoded and baked normals of faces"},
    {"transfer", "relative error of the transfer to the bake's"},
    {"decode", "time to rebuild a pose, the median of rounds over the sequence"},
};

}  // namespace

void curves_section(AnalysisRun& run) {
    const BakeReader& bake = run.bake;
    const Stage& stage = run.stage;
    const std::vector<NamedLight>& lights = stage.lights();
    const std::filesystem::path& output = run.page.directory();
    EncodeOptions everything;
    everything.geometry.kind = ComponentChoice::Kind::all;
    everything.transfer.kind = ComponentChoice::Kind::all;
    const Asset asset = encode_in_memory(bake, everything, output);
    const Reference& reference = run.reference();
    std::vector<Curve> curves = plan_curves(bake, asset, run.options.components, run.options.bands);
    if (run.options.lists_were_given) {
        say_what_was_left_out(curves, run.options.components, run.options.bands);
    }
    cli::Progress progress("measuring", "images", num_points(curves) * (stage.poses().size() + 1),
                           run.quiet());
    const MeasuredReference measured =
        measure_curves(bake, asset, stage, reference.source, curves, [&] { progress.advance(); });
    time_curves(asset, curves, [&] { progress.advance(); });
    progress.finish();
    say_what_was_not_measured(curves, lights);
    say_where_noise_is_large(run, measured.noise, curves);
    nlohmann::ordered_json& json = run.json;
    json["reference"]["kind"] = reference.name;
    for (size_t light = 0; light < lights.size(); ++light) {
        if (reference.traced) {
            json["reference"]["rays"][lights[light].name] = reference.traced->rays(light);
        }
        json["reference"]["noise"][lights[light].name] = measured.noise[light];
    }
    for (const Curve& curve : curves) {
        write_file(output / (curve.name + ".csv"), curve_csv(curve, lights, measured.noise));
        if (run.with_plots) write_plots(output, curve, lights);
        json[curve.name] = curve_json(curve, lights);
    }
    run.page.add_paragraph(
        fmt::format("Curves: pictures are compared with {}. Decode times are of {}.",
                    run.reference_text(), machine_name()));
    run.page.add_glossary(kTerms);
    add_curves(run.page, curves, stage, measured.images, reference.name);
}

}  // namespace paim
