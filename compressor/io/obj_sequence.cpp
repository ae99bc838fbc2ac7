// A pose sequence in OBJ files.
#include "compressor/io/obj_sequence.h"

#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <exception>
#include <limits>
#include <utility>

#include "compressor/io/obj_normals.h"
#include "compressor/io/obj_parse.h"
#include "paim/base/check.h"
#include "paim/base/error.h"
#include "paim/base/file.h"
#include "paim/base/hash.h"
#include "paim/base/parallel.h"
#include "paim/mesh/mesh_report.h"
#include "paim/mesh/normals.h"
#include "paim/mesh/orientation.h"
#include "paim/mesh/origin.h"
#include "paim/mesh/seams.h"
#include "paim/mesh/sequence_places.h"
#include "paim/mesh/usual_bounds.h"

namespace paim {

namespace {

constexpr uint64_t kMaxFileBytes = uint64_t{4} << 30;

// The name of the first file for messages about another: without its folder if both have the same.
std::string reference_name(const std::filesystem::path& first, const std::filesystem::path& other) {
    return first.parent_path() == other.parent_path() ? first.filename().string() : first.string();
}

}  // namespace

ObjSequence::ObjSequence(std::vector<std::filesystem::path> files, const ObjOptions& options)
    : files_(std::move(files)), options_(options) {
    if (files_.empty()) throw_bad_input("no OBJ files: expected at least one");
    if (files_.size() > UINT32_MAX) throw_bad_input("{} OBJ files: too many", files_.size());
    build(check_files());
}

// Returns the triangles of the faces.
Triangulation ObjSequence::check_files() {
    checksums_.resize(files_.size());
    offsets_.assign(files_.size(), Vec3d::Zero());
    std::vector<BoundsD> bounds(files_.size());  // of vertices of faces
    std::vector<BoundsD> usual(files_.size());   // of most of them
    std::optional<Triangulator> triangulator;
    std::optional<SequencePlaces> places;
    const auto check = [&](size_t i) {
        std::vector<char> text = read_file(files_[i], kMaxFileBytes);
        checksums_[i] = xxh3(text.data(), text.size());
        const ObjReference reference{reference_name(files_[0], files_[i]), first_};
        const bool finds_colours = i == 0 && !options_.albedo;
        if (finds_colours) exporter_ = srgb_exporter(text);
        ObjScan scan = scan_obj(files_[i].string(), text,
                                {options_.normals_from_file, i > 0 ? &reference : nullptr, true,
                                 i == 0 && needs_materials(options_), finds_colours,
                                 finds_colours && options_.textures});
        for (const uint32_t v : scan.faces.corners) bounds[i].extend(scan.positions[v]);
        const UsualBounds most = usual_bounds(scan.positions, scan.faces.corners, bounds[i]);
        usual[i] = most.bounds;
        if (places && !is_reference(i)) places->add(scan.positions, most);
        const Vec3d origin = options_.origin.value_or(choose_origin(usual[i]));
        if (i > 0) {
            triangulator->review(static_cast<uint32_t>(i), scan.positions, origin);
        } else {
            origin_ = origin;  // of this file; that of all is not known yet
            const std::vector<Vec3f> positions = local(0, scan.positions);
            references_.push_back(std::exchange(scan.positions, {}));
            first_ = std::move(scan);
            triangulator.emplace(first_.faces, positions);
        }
        if (options_.on_file_checked) options_.on_file_checked();
    };
    check(0);
    if (read_references() && !options_.normals_from_file) compare_references(places);

    // Files after one that failed are skipped. Those before it are checked, because the first error
    // in the order of the sequence is reported.
    std::atomic<size_t> first_failed{files_.size()};
    std::vector<std::exception_ptr> failures(files_.size());
    parallel_for(files_.size(), 1, [&](size_t i, size_t) {
        if (i == 0 || i > first_failed.load()) return;
        try {
            check(i);
        } catch (...) {
            failures[i] = std::current_exception();
            size_t known = first_failed.load();
            while (i < known && !first_failed.compare_exchange_weak(known, i)) {
            }
        }
    });
    const size_t failed = first_failed.load();
    if (failed < files_.size()) std::rethrow_exception(failures[failed]);
    BoundsD all;
    for (const BoundsD& of_file : bounds) all.extend(of_file);
    check_size(all);
    all = {};
    for (const BoundsD& of_file : usual) all.extend(of_file);
    origin_ = options_.origin.value_or(choose_origin(all));
    if (!options_.origin) choose_offsets(usual);
    for (size_t i = 0; i < files_.size(); ++i) check_local(i, bounds[i]);
    if (places) {
        first_places_ = places->first_places();
        longest_edge_ = places->longest_edge();
        places_ = places->finish();
    }
    return triangulator->finish();
}

bool ObjSequence::is_reference(size_t file) const {
    const std::vector<uint32_t> poses = reference_poses(num_poses());
    return std::find(poses.begin(), poses.end(), file) != poses.end();
}

// Reads the positions of the reference poses, after those of the first. Returns false if one of them
// is damaged: check_files() reports it, or a file before it.
bool ObjSequence::read_references() {
    for (const uint32_t p : reference_poses(num_poses())) {
        if (p == 0) continue;
        try {
            std::vector<char> text = read_file(files_[p], kMaxFileBytes);
            ObjScan scan = scan_obj(files_[p].string(), text, {false, nullptr, true});
            if (scan.num_vertices != first_.num_vertices) return false;
            references_.push_back(std::move(scan.positions));
        } catch (const Error&) {
            return false;
        }
    }
    return true;
}

void ObjSequence::compare_references(std::optional<SequencePlaces>& places) const {
    std::vector<SequencePlaces::Reference> references;
    for (const std::vector<Vec3d>& positions : references_) {
        BoundsD bounds;
        for (const uint32_t v : first_.faces.corners) bounds.extend(positions[v]);
        references.push_back({positions, usual_bounds(positions, first_.faces.corners, bounds)});
    }
    places.emplace(num_poses(), references);
}

// Error for meshes below the normal floats. Such floats have fewer digits, so rays would start
// within the surface.
void ObjSequence::check_size(const BoundsD& bounds) const {
    constexpr auto kSmallest = static_cast<double>(std::numeric_limits<float>::min());
    const double diagonal = bounds.diagonal();
    if (!(diagonal > 0.0) || diagonal >= kSmallest) return;
    throw_bad_input("{}: the mesh is {:.3g} across, expected at least {:.3g}: scale it up",
                    files_[0].string(), diagonal, kSmallest);
}

// Error if local() coordinates are not finite. Rounding is monotonic, so checking the bounds is
// enough.
void ObjSequence::check_local(size_t file, const BoundsD& bounds) const {
    if (bounds.empty()) return;
    const std::vector<Vec3d> corners{bounds.lower, bounds.upper};
    const std::vector<Vec3f> near = local(file, corners);
    for (size_t j = 0; j < corners.size(); ++j) {
        // From the origin as well, for what is counted from there.
        if (near[j].allFinite() && (corners[j] - origin_).cast<float>().allFinite()) continue;
        throw_bad_input("{}: coordinates are too large when counted from the origin ({}, {}, {})",
                        files_[file].string(), origin_.x(), origin_.y(), origin_.z());
    }
}

// Poses that are far from the origin of all get origins of their own.
// bounds  of the faces of each file
void ObjSequence::choose_offsets(const std::vector<BoundsD>& bounds) {
    for (size_t i = 0; i < bounds.size(); ++i) {
        if (bounds[i].empty()) continue;
        BoundsD from_origin;
        from_origin.extend(bounds[i].lower - origin_);
        from_origin.extend(bounds[i].upper - origin_);
        offsets_[i] = choose_origin(from_origin);
    }
}

// Subtracts origin and offset in double, then rounds to float.
std::vector<Vec3f> ObjSequence::local(size_t file, const std::vector<Vec3d>& positions) const {
    const Vec3d origin = origin_ + offsets_[file];
    std::vector<Vec3f> moved(positions.size());
    for (size_t v = 0; v < moved.size(); ++v) moved[v] = (positions[v] - origin).cast<float>();
    return moved;
}

std::vector<char> ObjSequence::read_unchanged(uint32_t p) const {
    std::vector<char> text = read_file(files_[p], kMaxFileBytes);
    if (xxh3(text.data(), text.size()) != checksums_[p]) {
        throw_bad_input("{}: changed since the sequence was opened", pose_name(p));
    }
    return text;
}

void ObjSequence::build(Triangulation cut) {
    const std::string name = pose_name(0);
    if (cut.triangles.empty()) {
        throw_bad_input("{}: no faces with three different vertices", name);
    }
    topology_ = {first_.num_vertices, std::move(cut.triangles)};
    std::vector<std::vector<Vec3f>> poses;
    const std::vector<uint32_t> numbers = reference_poses(num_poses());
    for (size_t r = 0; r < references_.size(); ++r) {
        poses.push_back(local(numbers[r], references_[r]));
        references_[r] = {};
    }
    check_orientation(poses);
    surface_ =
        read_surface(files_[0], first_, exporter_, options_, topology_, cut.polygons, poses[0]);
    warnings_.insert(warnings_.begin(), surface_.warnings.begin(), surface_.warnings.end());
    distinct_ = without_duplicate_faces(topology_);
    seams_ = find_seams(distinct_, places_, poses[0], longest_edge_);
    references_.clear();
    places_ = first_places_ = {};
    if (!options_.albedo && first_.num_uncolored > 0) {
        warnings_.push_back(fmt::format(
            "{}: vertex colours ignored: {} vertices of faces have none, e.g. vertex {}", name,
            first_.num_uncolored, uint64_t{first_.first_uncolored} + 1));
    }
    const auto warn = [&](uint64_t count, const char* what) {
        if (count > 0) warnings_.push_back(fmt::format("{}: {} {}", name, count, what));
    };
    warn(first_.num_small_faces, "faces of fewer than 3 vertices ignored");
    warn(first_.num_other_shapes, "points and lines ignored");
    warn(cut.num_repeating, "faces name a vertex twice");
    warn(cut.num_degenerate, "faces without area or tangled, cut as fans");
}

// Names the closed parts that face inwards; turns them if asked.
// poses  the reference poses
void ObjSequence::check_orientation(std::span<const std::vector<Vec3f>> poses) {
    constexpr size_t kMaxNamed = 6;
    const std::vector<InwardPart> parts = find_inward_parts(topology_, poses, first_places_);
    num_inward_ = parts.size();
    for (size_t i = 0; i < std::min(parts.size(), kMaxNamed); ++i) {
        warnings_.push_back(fmt::format(
            "{}: {} is closed ({} triangles) and faces inwards: {}", pose_name(0),
            part_name(parts[i].first_vertex), parts[i].triangles.size(),
            options_.orient ? "turned" : "--orient turns it, so that its outside is lit"));
    }
    if (parts.size() > kMaxNamed) {
        warnings_.push_back(fmt::format("{}: {} more closed parts face inwards{}", pose_name(0),
                                        parts.size() - kMaxNamed,
                                        options_.orient ? ": turned" : ""));
    }
    if (!options_.orient) return;
    for (const InwardPart& part : parts) turn_triangles(part.triangles, topology_);
}

// The object or group of the first face with this vertex, and the vertex.
std::string ObjSequence::part_name(uint32_t vertex) const {
    const std::vector<uint32_t>& corners = first_.faces.corners;
    const auto corner =
        static_cast<size_t>(std::find(corners.begin(), corners.end(), vertex) - corners.begin());
    size_t face = 0;
    for (size_t end = 0; face < first_.faces.num_faces(); ++face) {
        end += first_.faces.sizes[face];
        if (corner < end) break;
    }
    const ObjName* name = nullptr;
    for (const ObjName& entry : first_.names) {
        if (entry.first_face <= face) name = &entry;
    }
    const std::string place = fmt::format("vertex {}", uint64_t{vertex} + 1);
    if (name == nullptr || name->name.empty()) return fmt::format("the part with {}", place);
    return fmt::format("the part with {} in '{}'", place, name->name);
}

std::string ObjSequence::pose_name(uint32_t p) const {
    PAIM_CHECK_LT(p, num_poses());
    return files_[p].string();
}

uint64_t ObjSequence::pose_checksum(uint32_t p) const {
    PAIM_CHECK_LT(p, num_poses());
    return checksums_[p];
}

std::vector<Vec3f> ObjSequence::load_positions(uint32_t p) const {
    PAIM_CHECK_LT(p, num_poses());
    std::vector<char> text = read_unchanged(p);
    return local(p, scan_positions(pose_name(p), text));
}

Pose ObjSequence::load_pose(uint32_t p) const {
    PAIM_CHECK_LT(p, num_poses());
    Pose pose;
    if (!options_.normals_from_file) {
        pose.positions = load_positions(p);
        pose.normals = vertex_normals(distinct_, pose.positions, seams_);
        return pose;
    }
    const std::string name = pose_name(p);
    std::vector<char> text = read_unchanged(p);
    const ObjScan scan = scan_obj(name, text, {true, nullptr, true});
    const ParsedObj parsed = parse_obj(name, text, scan);
    pose.positions = local(p, scan.positions);
    pose.normals = obj_normals(distinct_, scan.faces, parsed, pose.positions);
    return pose;
}

}  // namespace paim
