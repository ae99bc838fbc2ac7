// The steps of paim-compress.
#include "compressor/pipeline.h"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "compressor/bake_input.h"
#include "compressor/bake_report.h"
#include "compressor/chosen_rays.h"
#include "compressor/encode/memory/measuring_memory.h"
#include "compressor/encode/memory/memory_plan.h"
#include "compressor/encode/search/feasibility.h"
#include "compressor/encode/search/glossy_encode.h"
#include "compressor/encode/search/less_noise.h"
#include "compressor/encode/search/target_encode.h"
#include "compressor/encode_notes.h"
#include "compressor/encode_report.h"
#include "compressor/gloss_plan.h"
#include "compressor/gloss_report.h"
#include "compressor/hidden_directory.h"
#include "compressor/mesh_warnings.h"
#include "compressor/outlier_notes.h"
#include "compressor/output_check.h"
#include "compressor/target_report.h"
#include "paim/base/error.h"
#include "paim/base/file.h"
#include "paim/base/json_text.h"
#include "paim/base/parallel.h"
#include "paim/base/tbb_parallel.h"
#include "paim/cli/light_options.h"
#include "paim/cli/progress.h"
#include "paim/format/bake/bake_removal.h"

namespace paim {

using nlohmann::ordered_json;

namespace {

// Prints the report as text, unless JSON is wanted, which is printed at the end.
template <typename Report>
ordered_json tell(const CompressOptions& options, const Report& report) {
    if (!options.json) fmt::print("{}", report_text(report));
    return report_json(report);
}

// Chooses the bands of the gloss once, for all that follows, and says what gloss will take.
std::optional<GlossPlan> choose_gloss(const BakeInput& input, BakeOptions& options) {
    std::optional<GlossPlan> plan = plan_gloss(input, options);
    if (!plan) {
        if (options.gloss_in_bands > 0) {
            print_notes({"--gloss-bands is not used: no material is glossy"});
        }
        return plan;
    }
    options.gloss_in_bands = plan->layout.in_bands;
    options.gloss_out_bands = plan->layout.out_bands;
    print_notes(gloss_notes(*plan, input.last_pose() - input.first_pose() + 1));
    return plan;
}

// Error, before a long bake, if the disk has no room for it.
void check_space(const BakeOptions& options, const BakeInput& input,
                 const std::optional<GlossPlan>& gloss, const std::filesystem::path& directory) {
    const uint64_t pose_bytes =
        pose_file_bytes(input.poses().topology().num_vertices, input.layout(options)) +
        (gloss ? gloss->pose_file_bytes() : 0);
    check_bake_space(directory, pose_bytes, input.first_pose(), input.last_pose());
}

// Error, before a long bake, if transfer of this layout could not be encoded in the memory allowed. How
// many components a target takes, and with them its memory, is known from the bake alone.
void check_encoding_memory(const CompressOptions& options, const EncodeSize& size,
                           const TransferLayout& layout) {
    const std::string what = options.output.string();
    choose_num_in_flight(encode_size(size, options.encode), options.encode.memory_bytes, what);
    if (options.encode.measure && !options.target) {
        check_measuring_memory(size, layout, options.encode, what);
    }
}

// The same for all that a bake will hold.
void check_encoding_memory(const CompressOptions& options, const BakeInput& input,
                           const std::optional<GlossPlan>& gloss) {
    const PoseSource& poses = input.poses();
    const StillMesh& still_mesh = input.surroundings().still_mesh;
    const TransferLayout layout = input.layout(options.bake);
    EncodeSize size;
    size.num_triangles = poses.topology().triangles.size();
    size.num_colours = poses.albedo().values.size();
    size.num_poses = poses.num_poses();
    size.num_threads = static_cast<uint64_t>(max_parallelism());
    size.num_vertices = poses.topology().num_vertices;
    size.bands = layout.in_bands;
    size.texture_bytes = poses.texture().size_bytes() + still_mesh.texture.size_bytes();
    size.still_mesh_bytes = still_mesh_bytes(still_mesh.topology, still_mesh.albedo, layout);
    check_encoding_memory(options, size, layout);
    if (!gloss || gloss->num_rows == 0) return;
    size.num_vertices = gloss->num_rows;
    size.bands = gloss->layout.in_bands;
    size.still_mesh_bytes = baked_pose_bytes(gloss->num_still_rows, gloss->layout);
    check_encoding_memory(options, size, gloss->layout);
}

BakeReport bake(const CompressOptions& options, const BakeInput& input,
                const std::filesystem::path& directory, const char* label = "baking") {
    BakeReport report = input.report();
    report.bake = directory;
    report.options = options.bake;
    report.channels = input.layout(options.bake).channels;
    cli::Progress baking(label, "poses", input.last_pose() - input.first_pose() + 1,
                         options.quiet || options.json);
    report.summary = bake_sequence(
        input.poses(), options.bake, options.normals, directory, input.first_pose(),
        input.last_pose(), [&](uint32_t) { baking.advance(); }, input.surroundings(),
        input.root_motion());
    baking.finish();
    return report;
}

void warn_of_mesh(const BakeReport& report) {
    print_warnings(mesh_warnings(report.summary.total.mesh));
}

EncodeReport encode_streamed(const CompressOptions& options, const EncodeOptions& encode_options,
                             const BakeReader& reader, const std::filesystem::path& output,
                             const char* label = "encoding") {
    cli::Progress encoding(label, "rows", num_rows_to_read(reader, encode_options),
                           options.quiet || options.json);
    EncodeReport report{output, reader.identity().num_vertices, reader.num_poses(), {}};
    report.summary =
        encode(reader, encode_options, output, [&](uint64_t rows) { encoding.advance(rows); });
    encoding.finish();
    return report;
}

// Both kinds of transfer, each by itself, joined.
GlossReport<EncodeReport> encode_glossy_streamed(const CompressOptions& options,
                                                 const EncodeOptions& encode_options,
                                                 const BakeReader& reader) {
    const HiddenDirectory scratch(options.output, "parts");
    const TransferFiles files{scratch.path() / "diffuse.paim", scratch.path() / "gloss.paim"};
    GlossReport<EncodeReport> report{
        options.output, 0, reader.identity().num_vertices, reader.num_poses(), {}, {}, {}, {}};
    report.diffuse = encode_streamed(options, encode_options, reader, files.diffuse);
    report.gloss =
        encode_streamed(options, encode_options, reader.gloss(), files.gloss, "encoding gloss");
    report.diffuse.paim = "diffuse transfer";
    report.gloss.paim = "gloss";
    const BandPower flat = BandPower::flat(reader.gloss().identity().layout.in_bands);
    const JoinedFile joined = join_transfer_files(reader, files, flat, options.output);
    report.size_bytes = joined.size_bytes;
    report.frames = joined.frames;
    return report;
}

// Of 100 %. Work that is done again does not count backwards.
SearchProgress::Listener shown_on(cli::Progress& progress) {
    return [&progress, percent = uint64_t{0}](const std::string& step, double done) mutable {
        const auto now = std::max(percent, static_cast<uint64_t>(100.0 * done));
        progress.set_label("encoding, " + step);
        progress.advance(now - percent);
        percent = now;
    };
}

EncodeTarget target_of(const CompressOptions& options, const BakeReader& reader) {
    EncodeTarget target = *options.target;
    target.spectrum = parse_band_power(options.band_power, reader.identity().layout.in_bands,
                                       options.env_mapping);
    return target;
}

TargetReport encode_target(const CompressOptions& options, const EncodeOptions& encode_options,
                           const BakeReader& reader) {
    const EncodeTarget target = target_of(options, reader);
    cli::Progress encoding("encoding", "%", 100, options.quiet || options.json);
    TargetReport report{options.output, encode_to_target(reader, encode_options, target,
                                                         options.output, shown_on(encoding))};
    encoding.set_label("encoding");
    encoding.finish();
    return report;
}

GlossReport<TargetReport> encode_glossy_target(const CompressOptions& options,
                                               const EncodeOptions& encode_options,
                                               const BakeReader& reader) {
    GlossyTarget target{target_of(options, reader), target_of(options, reader.gloss())};
    if (options.gloss_error) target.gloss.transfer_error = options.gloss_error;
    const HiddenDirectory scratch(options.output, "parts");
    cli::Progress encoding("encoding", "%", 200, options.quiet || options.json);
    auto shown = shown_on(encoding);
    // The diffuse part is the first half, and the gloss the second; both together are the whole.
    const auto done_of_two = [](const std::string& part, double done) {
        return part == "gloss" ? 1.0 + done : part == "both" ? 2.0 * done : done;
    };
    const GlossySummary summary =
        encode_glossy_to_target(reader, encode_options, target, scratch.path(), options.output,
                                [&](const char* part, const std::string& step, double done) {
                                    shown(part + std::string(", ") + step, done_of_two(part, done));
                                });
    encoding.set_label("encoding");
    encoding.finish();
    return {options.output,
            summary.both.size_bytes,
            reader.identity().num_vertices,
            reader.num_poses(),
            {"diffuse transfer", summary.diffuse},
            {"gloss", summary.gloss},
            summary.both.frames,
            summary.gloss_error()};
}

// Forgets the option, so that it is said once.
void say_if_no_gloss_error(CompressOptions& options, bool has_gloss) {
    if (!options.gloss_error || has_gloss) return;
    say_gloss_error_is_unused("the bake has no gloss");
    options.gloss_error.reset();
}

// Checks the option before long work starts, and says how its map was read.
void check_band_power(const CompressOptions& options, uint32_t bands) {
    if (!options.target) return;
    const BandPower power = parse_band_power(options.band_power, bands, options.env_mapping);
    cli::print_notes("paim-compress", options.band_power, power.notes);
}

// The report of an encoding with the outliers of its bake, which notes name.
template <typename Report>
ordered_json tell_with_outliers(const CompressOptions& options, const BakeIdentity& bake,
                                const Report& report, const PositionOutliers& outliers) {
    ordered_json json = tell(options, report);
    if (outliers.empty()) return json;
    print_notes(outlier_notes(bake, outliers));
    json["outliers"] = outliers_json(bake, outliers);
    return json;
}

ordered_json run_bake(CompressOptions options) {
    check_output(options.output);
    const BakeInput input(options);
    const std::optional<GlossPlan> gloss = choose_gloss(input, options.bake);
    check_space(options.bake, input, gloss, options.output);
    const BakeReport report = bake(options, input, options.output);
    warn_of_mesh(report);
    return tell(options, report);
}

ordered_json run_glossy_encode(const CompressOptions& options, const EncodeOptions& encode_options,
                               const BakeReader& reader) {
    if (options.target) {
        const auto report = encode_glossy_target(options, encode_options, reader);
        return tell_with_outliers(options, reader.identity(), report,
                                  report.diffuse.summary.outliers);
    }
    const auto report = encode_glossy_streamed(options, encode_options, reader);
    const bool is_noisy =
        report.diffuse.more_rays_would_help() || report.gloss.more_rays_would_help();
    if (!options.json && is_noisy) say_more_rays_help();
    return tell_with_outliers(options, reader.identity(), report, report.diffuse.summary.outliers);
}

ordered_json run_encode(CompressOptions options, const std::filesystem::path& directory) {
    check_paim_output(options.output);
    const BakeReader reader(directory);
    EncodeOptions encode_options = options.encode;
    encode_options.name = options.output.stem().string();
    check_memory(reader, encode_options);
    if (!reader.gloss_rows().empty()) check_memory(reader.gloss(), encode_options);
    check_band_power(options, reader.identity().layout.in_bands);
    reader.verify_all();
    say_if_dark(reader);
    say_if_fewer_bands(encode_options, reader);
    if (reader.gloss_rows().empty()) say_if_without_gloss(options.gloss_error.has_value(), reader);
    if (!reader.gloss_rows().empty()) return run_glossy_encode(options, encode_options, reader);
    if (options.target) {
        const TargetReport report = encode_target(options, encode_options, reader);
        return tell_with_outliers(options, reader.identity(), report, report.summary.outliers);
    }
    const EncodeReport report = encode_streamed(options, encode_options, reader, options.output);
    ordered_json json =
        tell_with_outliers(options, reader.identity(), report, report.summary.outliers);
    if (!options.json && report.more_rays_would_help()) say_more_rays_help();
    return json;
}

// An error about a pilot is one about the bake that it stands for.
[[noreturn]] void throw_as_of_bake(const Error& error, const std::filesystem::path& pilot,
                                   const std::filesystem::path& bake) {
    std::string message = error.what();
    const std::string name = pilot.string();
    if (message.starts_with(name)) message.replace(0, name.size(), bake.string());
    throw Error(error.code(), message);
}

// Chooses the rays of the bake by the noise of a pilot, which is the bake if it is good enough.
// json  receives what the pilot was
uint32_t choose_rays(CompressOptions options, const BakeInput& input,
                     const std::filesystem::path& directory, ordered_json& json) {
    const HiddenDirectory pilot(directory, "pilot");
    options.bake.rays = pilot_rays(*options.target->transfer_error);
    warn_of_mesh(bake(options, input, pilot.path(), "baking a pilot"));
    const BakeReader reader(pilot.path());
    uint32_t rays = 0;
    try {
        const EncodeTarget target = target_of(options, reader);
        cli::Progress encoding("encoding", "%", 100, options.quiet || options.json);
        const EncodeProblem problem = read_problem(
            reader, options.encode, target, std::make_shared<SearchProgress>(shown_on(encoding)));
        encoding.set_label("encoding the pilot");
        encoding.finish();
        rays = rays_to_meet(problem, target);
        json = {{"rays", options.bake.rays}, {"best_transfer_error", problem.least_error()}};
        print_notes({chosen_rays_note(rays, options.bake.rays, target, problem)});
    } catch (const Error& error) {
        throw_as_of_bake(error, pilot.path(), directory);
    }
    if (rays <= options.bake.rays) pilot.become(directory);
    return std::max(rays, options.bake.rays);
}

// Bakes with as few rays as the target allows, again with more while noise is in its way, and
// encodes. A bake that was there keeps its rays.
ordered_json run_with_chosen_rays(CompressOptions options, const BakeInput& input,
                                  const std::filesystem::path& directory) {
    ordered_json json;
    const std::optional<uint32_t> rays_there = rays_of_begun_bake(directory);
    if (rays_there) {
        options.bake.rays = *rays_there;
        print_notes({fmt::format("{}: is there and keeps its {} rays a vertex", directory.string(),
                                 *rays_there)});
    } else if (!is_foreign_directory(directory)) {
        options.bake.rays = choose_rays(options, input, directory, json["pilot"]);
        remove_bake_of_other_rays(directory, options.bake.rays);
    }
    for (int num_bakes = 1;; ++num_bakes) {
        const BakeReport report = bake(options, input, directory);
        if (rays_there) warn_of_mesh(report);
        json["bake"] = tell(options, report);
        try {
            json["encode"] = run_encode(options, directory);
            return json;
        } catch (const TooNoisy& noisy) {
            if (rays_there) {
                throw_infeasible(fmt::format(
                    "{}; this bake was there: remove it, and the rays are chosen, or choose another "
                    "output",
                    noisy.what()));
            }
            if (num_bakes == kMaxBakes) throw;
            print_notes({fmt::format("{}; it is baked again with {}", noisy.what(), noisy.rays())});
            options.bake.rays = noisy.rays();
        }
        remove_bake(directory);
    }
}

// All that is checked before a long bake whose result is encoded.
void check_both(CompressOptions& options, const BakeInput& input,
                const std::filesystem::path& directory) {
    const std::optional<GlossPlan> gloss = choose_gloss(input, options.bake);
    say_if_no_gloss_error(options, gloss && gloss->num_rows > 0);
    check_encoding_memory(options, input, gloss);
    check_space(options.bake, input, gloss, directory);
}

ordered_json run_both(CompressOptions options) {
    check_paim_output(options.output);
    check_band_power(options, options.bake.bands);
    std::filesystem::path directory = options.output;
    directory.replace_extension(".bake");
    check_output(directory);
    ordered_json json;
    if (options.chooses_rays) {
        const BakeInput input(options);
        check_both(options, input, directory);
        json = run_with_chosen_rays(options, input, directory);
    } else {
        {
            const BakeInput input(options);
            check_both(options, input, directory);
            const BakeReport report = bake(options, input, directory);
            warn_of_mesh(report);
            json["bake"] = tell(options, report);
        }
        json["encode"] = run_encode(options, directory);
    }
    if (options.discard_bake) remove_bake(directory);
    return json;
}

ordered_json run_command(const CompressOptions& options) {
    switch (options.command) {
        case CompressOptions::Command::bake:
            return run_bake(options);
        case CompressOptions::Command::encode:
            return run_encode(options, options.bake_directory);
        case CompressOptions::Command::bake_and_encode:
            return run_both(options);
    }
    return {};
}

}  // namespace

void run(const CompressOptions& options) {
    const ThreadLimit limit(options.num_threads);
    const ordered_json json = run_command(options);
    if (options.json) {
        fmt::print("{}\n", json_text(json, 2));
    }
}

}  // namespace paim
