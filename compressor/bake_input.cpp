// The input of a bake of paim-compress: poses from OBJ files, their floor, and still meshes.
#include "compressor/bake_input.h"

#include <charconv>
#include <memory>
#include <span>
#include <tuple>
#include <utility>

#include "compressor/io/obj_files.h"
#include "compressor/mesh_warnings.h"
#include "compressor/scene/floor.h"
#include "compressor/scene/root_motion.h"
#include "paim/base/error.h"
#include "paim/cli/progress.h"

namespace paim {

namespace {

bool is_quiet(const CompressOptions& options) {
    return options.quiet || options.json;
}

ObjSequence open_sequence(const CompressOptions& options) {
    std::vector<std::string> notes;
    const auto files = find_obj_files(options.inputs, options.keep_order, &notes);
    print_notes(notes);
    // Shared, because the sequence keeps the callback.
    const auto checking =
        std::make_shared<cli::Progress>("checking", "files", files.size(), is_quiet(options));
    ObjOptions obj_options;
    obj_options.normals_from_file = options.normals == "file";
    obj_options.orient = options.orient;
    obj_options.albedo = options.albedo;
    obj_options.vertex_colours = options.vertex_colours;
    obj_options.gloss = options.gloss;
    obj_options.textures = options.textures;
    obj_options.on_file_checked = [checking] { checking->advance(); };
    ObjSequence sequence(files, obj_options);
    checking->finish();
    return sequence;
}

// "A-B" or "A" as first and last pose, inclusive. Error (usage) unless A <= B < num_poses.
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

}  // namespace

BakeInput::BakeInput(const CompressOptions& options)
    : sequence_(open_sequence(options)), topology_(report_topology(sequence_.topology())) {
    print_warnings(sequence_.warnings());
    print_notes(sequence_.notes());
    print_warnings(mesh_warnings(topology_));
    std::tie(first_pose_, last_pose_) = parse_pose_range(options.poses, sequence_.num_poses());
    find_motion(options);
    if (options.floor) add_floor(options);
    has_library_gloss_ = sequence_.has_library_gloss();
    for (const std::string& file : options.statics) add_still_mesh(options, file);
    if (options.gloss.from_libraries && !has_library_gloss_) {
        print_notes({"--gloss is not used: no library has a glossy material of a face"});
    }
}

void BakeInput::add_floor(const CompressOptions& options) {
    cli::Progress measuring("measuring", "poses", sequence_.num_poses(), is_quiet(options));
    const BodyBounds bounds = bounds_of(
        sequence_, [&] { measuring.advance(); }, root_motion_);
    measuring.finish();
    on_floor_.emplace(sequence_, bounds, *options.floor);
    surroundings_.floor = on_floor_->description();
}

void BakeInput::find_motion(const CompressOptions& options) {
    if (options.root_motion == RootMotionChoice::none) return;
    if (sequence_.num_poses() < 2) return;
    cli::Progress finding("finding the root motion", "poses", sequence_.num_poses(),
                          is_quiet(options));
    root_motion_ = find_root_motion(
        sequence_, options.root_motion, [&] { finding.advance(); },
        options.floor ? LocalOrigin::reference : LocalOrigin::centre);
    finding.finish();
}

void BakeInput::add_still_mesh(const CompressOptions& options, const std::string& file) {
    ObjOptions obj_options;
    obj_options.normals_from_file = options.normals == "file";
    obj_options.orient = options.orient;
    obj_options.origin = sequence_.origin();
    obj_options.vertex_colours = options.vertex_colours;
    obj_options.gloss.from_libraries = options.gloss.from_libraries;
    obj_options.textures = options.textures;
    const ObjSequence still({file}, obj_options);
    print_warnings(still.warnings());
    print_notes(still.notes());
    has_library_gloss_ = has_library_gloss_ || still.has_library_gloss();
    surroundings_.still_mesh.add(still);
    const Topology& mesh = still.topology();
    const auto positions =
        std::span(surroundings_.still_mesh.pose.positions).last(mesh.num_vertices);
    still_meshes_.push_back({file, report_topology(mesh), report_pose(mesh, positions),
                             still.vertex_colours(), still.num_inward()});
    const StillMeshReport& report = still_meshes_.back();
    print_warnings(still_mesh_warnings(file, report.topology, report.pose));
}

const PoseSource& BakeInput::poses() const {
    if (on_floor_) return *on_floor_;
    return sequence_;
}

TransferLayout BakeInput::layout(const BakeOptions& options) const {
    return TransferBaker::bake_layout(options, poses().albedo(), surroundings_.still_mesh,
                                      poses().materials());
}

BakeReport BakeInput::report() const {
    BakeReport report;
    report.num_vertices = poses().topology().num_vertices;
    report.num_triangles = poses().topology().triangles.size();
    report.num_poses = sequence_.num_poses();
    report.first_pose = first_pose_;
    report.last_pose = last_pose_;
    report.floor = surroundings_.floor;
    report.origin_y = sequence_.origin().y();
    report.still_vertices = surroundings_.still_mesh.topology.num_vertices;
    report.still_triangles = surroundings_.still_mesh.topology.triangles.size();
    report.vertex_colours = sequence_.vertex_colours();
    report.topology = topology_;
    report.root_motion = root_motion_;
    report.num_inward = sequence_.num_inward();
    report.still_meshes = still_meshes_;
    return report;
}

}  // namespace paim
