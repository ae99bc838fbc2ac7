// A pose sequence in OBJ files, one a pose.
#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "compressor/io/obj_scan.h"
#include "compressor/io/obj_surface.h"
#include "compressor/io/triangulate.h"
#include "paim/mesh/bounds.h"
#include "paim/mesh/pose_source.h"
#include "paim/mesh/sequence_places.h"

namespace paim {

struct ObjOptions : ObjSurfaceOptions {
    // False: normals are computed from the faces (mesh/normals.h), and vertices on both sides of a
    // seam share them (mesh/seams.h).
    // True: they are averaged from the file's vn (obj_normals.h).
    bool normals_from_file = false;
    // Whether closed parts that face inwards (mesh/orientation.h) are turned.
    bool orient = false;
    // Origin of positions, instead of the one that mesh/origin.h chooses.
    std::optional<Vec3d> origin;
    // Called whenever a file has been checked, by several threads at once.
    std::function<void()> on_file_checked;
};

// All files must hold the same vertices and faces in the same order. Objects, groups, smoothing,
// points and lines are ignored. Texture coordinates are those of the first.
class ObjSequence : public PoseSource {
  public:
    // Checks all files (obj_scan.h) first, in parallel. The first one gives the surface
    // (obj_surface.h), and the cuts of polygons where they are right in all poses (triangulate.h).
    // files  at least one; find_obj_files() gives them. The same file may be several poses.
    // Errors (bad input): any file unreadable, above 4 GiB, damaged, unlike the first, or with a
    // vertex of a face whose coordinates are no finite floats relative to the origin; or a mesh
    // smaller than normal floats (1.2e-38). Of several errors, the first in the order of the
    // sequence is reported, on any number of threads (coordinates after all others).
    explicit ObjSequence(std::vector<std::filesystem::path> files, const ObjOptions& options = {});

    const Topology& topology() const override { return topology_; }
    const Albedo& albedo() const override { return surface_.albedo; }
    const Materials& materials() const override { return surface_.materials; }
    const Texture& texture() const override { return surface_.texture; }
    uint32_t num_poses() const override { return static_cast<uint32_t>(files_.size()); }
    // The origin of the options, or one chosen from the bounds of all poses (mesh/origin.h).
    Vec3d origin() const override { return origin_; }
    // A pose that is far from this origin has another one near its centre, by the same rule, unless
    // the options give the origin.
    Vec3d pose_offset(uint32_t p) const override { return offsets_[p]; }
    std::string pose_name(uint32_t p) const override;   // the path as given
    uint64_t pose_checksum(uint32_t p) const override;  // of the bytes of the file
    // Error (bad input) if the file has changed since the sequence was opened.
    Pose load_pose(uint32_t p) const override;
    std::vector<Vec3f> load_positions(uint32_t p) const override;  // the same error

    // Closed parts of the first pose that face inwards, or did before they were turned.
    size_t num_inward() const { return num_inward_; }

    // Oddities that are not errors: lines, each with the name of the file.
    const std::vector<std::string>& warnings() const { return warnings_; }
    // The same for what may well be meant.
    const std::vector<std::string>& notes() const { return surface_.notes; }
    // Of the first file.
    const VertexColours& vertex_colours() const { return surface_.vertex_colours; }
    // Whether the libraries have gloss that was asked for (ObjSurface).
    bool has_library_gloss() const { return surface_.has_library_gloss; }

  private:
    Triangulation check_files();
    bool is_reference(size_t file) const;
    bool read_references();
    void compare_references(std::optional<SequencePlaces>& places) const;
    void check_size(const BoundsD& bounds) const;
    void check_local(size_t file, const BoundsD& bounds) const;
    void build(Triangulation cut);
    void check_orientation(std::span<const std::vector<Vec3f>> poses);
    std::string part_name(uint32_t vertex) const;
    std::vector<char> read_unchanged(uint32_t p) const;
    std::vector<Vec3f> local(size_t file, const std::vector<Vec3d>& positions) const;
    void choose_offsets(const std::vector<BoundsD>& bounds);

    std::vector<std::filesystem::path> files_;
    ObjOptions options_;
    ObjScan first_;  // scan of the first file
    std::vector<uint64_t> checksums_;
    Vec3d origin_ = Vec3d::Zero();
    std::vector<Vec3d> offsets_;  // of the poses, from the origin
    Topology topology_;
    Topology distinct_;  // without duplicate faces, for the normals
    // Until seams are found: positions of the reference poses (mesh/sequence_places.h), and vertices
    // that share places: in the first file, if it has outliers, and in every one.
    std::vector<std::vector<Vec3d>> references_;
    std::vector<uint32_t> first_places_, places_;
    double longest_edge_ = 0.0;    // that is none of an outlier in the first pose
    std::vector<uint32_t> seams_;  // vertices that share normals (mesh/seams.h)
    std::string exporter_;         // of the first file, if it writes sRGB colours
    ObjSurface surface_;
    size_t num_inward_ = 0;
    std::vector<std::string> warnings_;
};

}  // namespace paim
