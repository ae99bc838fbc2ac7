// What paim-compress does, step by step.
#include "compressor/pipeline.h"

#include <fmt/format.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <nlohmann/json.hpp>
#include <optional>
#include <span>

#include "compressor/bake/bake_sequence.h"
#include "compressor/encode/memory/memory_plan.h"
#include "compressor/encode/state_errors.h"
#include "compressor/encode_report.h"
#include "compressor/io/obj_files.h"
#include "compressor/io/obj_sequence.h"
#include "compressor/mesh_warnings.h"
#include "compressor/scene/floor.h"
#include "compressor/target_report.h"
#include "paim/base/error.h"
#include "paim/base/file.h"
#include "paim/base/parallel.h"
#include "paim/base/tbb_parallel.h"
#include "paim/cli/progress.h"

namespace paim {

using nlohmann::ordered_json;

namespace {

// Names the output while the input can still be read: a long bake must not end in a typing mistake.
void check_output(const std::filesystem::path& output) {
    const std::filesystem::path parent = std::filesystem::absolute(output).parent_path();
    std::error_code ignored;
    if (!std::filesystem::is_directory(parent, ignored)) {
        throw_output_failed("{}: the directory {} does not exist", output.string(),
                            parent.string());
    }
    if (::access(parent.c_str(), W_OK) != 0) {
        throw_output_failed("{}: cannot write to {}: {}", output.string(), parent.string(),
                            std::strerror(errno));
    }
}

void check_paim_output(const std::filesystem::path& output) {
    check_output(output);
    if (std::filesystem::is_directory(output)) {
        throw_output_failed("{}: is a directory, expected a file name for the .paim",
                            output.string());
    }
}

void print_warnings(const std::vector<std::string>& warnings) {
    for (const std::string& warning : warnings) fmt::print(stderr, "warning: {}\n", warning);
}

// Before a long bake, what would be refused after it.
void check_encoding_memory(const CompressOptions& options, const PoseSource& poses,
                           const StaticMesh& scenery, const TransferLayout& layout) {
    EncodeSize size;
    size.num_triangles = poses.topology().triangles.size();
    size.num_colours = poses.albedo().values.size();
    size.num_poses = poses.num_poses();
    size.num_threads = static_cast<uint64_t>(max_parallelism());
    size.num_vertices = poses.topology().num_vertices;
    size.bands = layout.bands;
    const uint64_t num_still_values = 6 + 2 * uint64_t{layout.num_planes()};
    size.scenery_bytes = num_still_values * scenery.topology.num_vertices * sizeof(float) +
                         scenery.topology.triangles.size() * sizeof(Triangle) +
                         scenery.albedo.values.size() * sizeof(Vec3f);
    const std::string what = options.output.string();
    choose_num_in_flight(encode_size(size, options.encode), options.encode.memory_bytes, what);
    if (options.encode.measure && !options.target) {
        check_measuring_memory(size, layout, options.encode, what);
    }
}

ordered_json bake(const CompressOptions& options, const std::filesystem::path& directory) {
    check_output(directory);
    const auto files = find_obj_files(options.inputs, options.keep_order);
    const bool quiet = options.quiet || options.json;
    cli::Progress checking("checking", "files", files.size(), quiet);
    ObjOptions obj_options;
    obj_options.normals_from_file = options.normals == "file";
    obj_options.albedo = options.albedo;
    obj_options.on_file_checked = [&] { checking.advance(); };
    const ObjSequence sequence(files, obj_options);
    checking.finish();
    print_warnings(sequence.warnings());
    const TopologyReport topology = report_topology(sequence.topology());
    print_warnings(mesh_warnings(topology));

    const auto [first, last] = parse_pose_range(options.poses, sequence.num_poses());
    Surroundings surroundings;
    std::optional<PosesOnFloor> on_floor;
    if (options.floor) {
        cli::Progress measuring("measuring", "poses", sequence.num_poses(), quiet);
        const Bounds bounds = bounds_of(sequence, [&] { measuring.advance(); });
        measuring.finish();
        on_floor.emplace(sequence, bounds, *options.floor);
        surroundings.floor = on_floor->description();
    }
    ordered_json static_mesh = ordered_json::array();
    for (const std::string& file : options.statics) {
        ObjOptions static_options;
        static_options.normals_from_file = obj_options.normals_from_file;
        static_options.origin = sequence.origin();
        const ObjSequence still({file}, static_options);
        print_warnings(still.warnings());
        surroundings.scenery.add(still);
        const Topology& mesh = still.topology();
        const TopologyReport report = report_topology(mesh);
        const PoseReport pose_report = report_pose(
            mesh, std::span(surroundings.scenery.pose.positions).last(mesh.num_vertices));
        print_warnings(static_mesh_warnings(file, report, pose_report));
        static_mesh.push_back({{"file", file}});
        static_mesh.back().update(mesh_json(report, pose_report));
    }
    const PoseSource& poses = on_floor ? static_cast<const PoseSource&>(*on_floor) : sequence;
    const TransferLayout baked_layout =
        TransferBaker::bake_layout(options.bake, poses.albedo(), surroundings.scenery);
    if (options.command == CompressOptions::Command::bake_and_encode) {
        check_encoding_memory(options, poses, surroundings.scenery, baked_layout);
    }
    const uint32_t num_vertices = poses.topology().num_vertices;
    cli::Progress baking("baking", "poses", last - first + 1, quiet);
    const BakeSummary summary = bake_sequence(
        poses, options.bake, options.normals, directory, first, last,
        [&](uint32_t) { baking.advance(); }, surroundings);
    baking.finish();
    print_warnings(mesh_warnings(summary.total.mesh));

    const double noise = summary.total.relative_noise();
    ordered_json json;
    json["bake"] = directory.string();
    json["num_vertices"] = num_vertices;
    json["num_triangles"] = poses.topology().triangles.size();
    json["num_poses"] = sequence.num_poses();
    if (!surroundings.floor.empty()) json["floor"] = surroundings.floor;
    const StaticMesh& scenery = surroundings.scenery;
    if (!scenery.empty()) {
        json["scenery_vertices"] = scenery.topology.num_vertices;
        json["scenery_triangles"] = scenery.topology.triangles.size();
    }
    json["poses_baked"] = summary.baked;
    json["poses_resumed"] = summary.resumed;
    json["bands"] = options.bake.bands;
    json["rays"] = options.bake.rays;
    if (options.bake.transfer_error > 0.0) {
        json["transfer_error"] = options.bake.transfer_error;
        json["vertices_above_transfer_error"] = summary.total.above_target;
    }
    json["bounces"] = options.bake.bounces;
    json["channels"] = baked_layout.channels;
    json["rays_traced"] = summary.total.rays;
    json["rays_blocked"] = summary.total.occluded;
    json["vertices_without_normal"] = summary.total.zero_normals;
    json["relative_noise"] = noise;
    json["mesh"] = mesh_json(topology, summary.total.mesh);
    if (!static_mesh.empty()) json["static_mesh"] = static_mesh;
    if (!options.json) {
        fmt::print(
            "{}: {} vertices, {} triangles, poses {}-{} of {} ({} baked, {} found), {} bands\n",
            directory.string(), num_vertices, poses.topology().triangles.size(), first, last,
            sequence.num_poses(), summary.baked, summary.resumed, options.bake.bands);
        const double traced = static_cast<double>(num_vertices) * (last - first + 1.0) -
                              static_cast<double>(summary.total.zero_normals);
        fmt::print(
            "  {:.0f} rays a vertex, {:.1f} % occluded; estimated noise {:.2f} % of the transfer\n",
            traced > 0.0 ? static_cast<double>(summary.total.rays) / traced : 0.0,
            summary.total.rays > 0 ? 100.0 * static_cast<double>(summary.total.occluded) /
                                         static_cast<double>(summary.total.rays)
                                   : 0.0,
            100.0 * noise);
        const double target = options.bake.transfer_error;
        if (target > 0.0 && summary.total.above_target == 0) {
            fmt::print(
                "  noise at every vertex is within {:g} % of an unshadowed vertex's transfer, "
                "before "
                "any bounces\n",
                100.0 * target);
        } else if (target > 0.0) {
            fmt::print(
                "  {} vertices (over all poses) had {} rays and are still above the transfer error "
                "of {:g} %: raise --rays\n",
                summary.total.above_target, options.bake.rays, 100.0 * target);
        }
        if (options.bake.bounces > 0) {
            fmt::print("  {} bounces in {}; {:.2g} % of the rays ended on the back of a face\n",
                       options.bake.bounces, baked_layout.channels == 3 ? "colour" : "grey",
                       summary.total.rays > 0
                           ? 100.0 * static_cast<double>(summary.total.back_hits) /
                                 static_cast<double>(summary.total.rays)
                           : 0.0);
        }
        if (!surroundings.floor.empty()) {
            const double y = sequence.origin().y();
            fmt::print("  on a floor of {}{}\n", surroundings.floor,
                       y != 0.0 ? fmt::format(" (y counted from the origin's, {})", y) : "");
        }
        if (!scenery.empty()) {
            fmt::print("  among scenery of {} vertices and {} triangles\n",
                       scenery.topology.num_vertices, scenery.topology.triangles.size());
        }
        if (summary.total.zero_normals > 0) {
            fmt::print("  {} vertices (over all poses) have no normal; their transfer is 0\n",
                       summary.total.zero_normals);
        }
    }
    return json;
}

// Before anything long begins.
void check_band_power(const CompressOptions& options, uint32_t bands) {
    if (options.target) parse_band_power(options.band_power, bands);
}

ordered_json encode_target_to(const CompressOptions& options, const EncodeOptions& encode_options,
                              const BakeReader& reader) {
    EncodeTarget target = *options.target;
    target.spectrum = parse_band_power(options.band_power, reader.identity().layout.bands);
    const auto say = [&](const char* step) {
        if (!options.quiet && !options.json) fmt::print(stderr, "{} ...\n", step);
    };
    const TargetSummary summary =
        encode_to_target(reader, encode_options, target, options.output, say);
    ordered_json json;
    json["paim"] = options.output.string();
    json["num_vertices"] = summary.num_vertices;
    json["num_poses"] = summary.num_poses;
    json.update(target_json(summary));
    if (!options.json) fmt::print("{}", target_text(options.output.string(), summary));
    return json;
}

ordered_json encode_to(const CompressOptions& options, const std::filesystem::path& directory) {
    check_paim_output(options.output);
    const BakeReader reader(directory);
    EncodeOptions encode_options = options.encode;
    encode_options.name = options.output.stem().string();
    check_memory(reader, encode_options);
    check_band_power(options, reader.identity().layout.bands);
    reader.verify_all();
    if (options.target) return encode_target_to(options, encode_options, reader);
    cli::Progress encoding("encoding", "rows", num_rows_to_read(reader, encode_options),
                           options.quiet || options.json);
    const EncodeSummary summary = encode(reader, encode_options, options.output,
                                         [&](uint64_t rows) { encoding.advance(rows); });
    encoding.finish();
    std::optional<ModelError> error;
    if (options.encode.measure) {
        error =
            state_errors(options.output, reader, BandPower::flat(reader.identity().layout.bands),
                         encode_options.memory_bytes);
    }
    ordered_json json;
    json["paim"] = options.output.string();
    json["num_vertices"] = reader.identity().num_vertices;
    json["num_poses"] = reader.num_poses();
    json.update(encode_json(summary));
    if (error) {
        for (const NamedError& named : named_errors(*error)) {
            json["measured"][named.name] = named.value;
        }
        json["size_bytes"] = std::filesystem::file_size(options.output);
    }
    if (options.json) return json;
    fmt::print("{}", encode_text(options.output.string(), summary));
    if (error) {
        fmt::print(
            "  measured: transfer {:.3g} %, RMS distance {:.3g} ({:.2g} % of the diagonal)\n",
            100.0 * error->transfer.total(), error->geometry.rms(),
            100.0 * error->geometry.relative_rms());
    }
    if (more_rays_would_help(summary)) {
        fmt::print(stderr,
                   "note: most of the error is bake noise: more rays would help more than more "
                   "components (bake again with more --rays, into another .bake)\n");
    }
    return json;
}

void discard(const std::filesystem::path& directory) {
    std::error_code failure;
    std::filesystem::remove_all(directory, failure);
    if (failure) {
        throw_output_failed("{}: cannot remove: {}", directory.string(), failure.message());
    }
}

}  // namespace

void run(const CompressOptions& options) {
    const ThreadLimit limit(options.num_threads);
    ordered_json json;
    switch (options.command) {
        case CompressOptions::Command::bake:
            json = bake(options, options.output);
            break;
        case CompressOptions::Command::encode:
            json = encode_to(options, options.bake_directory);
            break;
        case CompressOptions::Command::bake_and_encode: {
            check_paim_output(options.output);
            check_band_power(options, options.bake.bands);
            std::filesystem::path directory = options.output;
            directory.replace_extension(".bake");
            json["bake"] = bake(options, directory);
            json["encode"] = encode_to(options, directory);
            if (options.discard_bake) discard(directory);
            break;
        }
    }
    if (options.json) {
        fmt::print("{}\n", json.dump(2, ' ', false, ordered_json::error_handler_t::replace));
    }
}

}  // namespace paim
