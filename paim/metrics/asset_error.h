// Errors of a compressed animation, of any codec, to the bake that it was made from.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "paim/codec/asset.h"
#include "paim/format/bake/bake_directory.h"
#include "paim/format/bake/baked_part.h"
#include "paim/metrics/band_power.h"
#include "paim/metrics/geometry_error.h"
#include "paim/metrics/shape_error.h"
#include "paim/metrics/transfer_error.h"

namespace paim {

// Errors of one part. Transfer errors are relative to the transfer of this part; position errors
// use the diagonal of this part. Outliers (mesh/outliers.h) are measured apart. In the other errors
// they count as vertices without error where they usually are.
struct SurfaceError {
    GeometryError geometry;
    PieceShapeError shape;
    DistanceError outliers;  // of outliers alone; nothing was added if there are none
};
struct MeshError : SurfaceError {
    TransferError transfer;
};

// Errors of the moving part, and of the still part if there is one.
struct AssetError : MeshError {
    std::optional<MeshError> still;
};

// [V] The vertex of the bake for each vertex of this part of a file. Errors: bad input if the part was
// not made from this bake; the message says what differs.
std::vector<uint32_t> match_part(const Asset& asset, size_t number, const BakeReader& bake);

// Decodes one part and measures its errors, any number of times. Vertices that no face has do not
// count (mesh/face_vertices.h). It keeps what belongs to the mesh, and a reference to the bake.
class PartMeter {
  public:
    // number  of the part, in the asset and in the bake
    // bake    verified (BakeReader::verify_all)
    // Errors: those of match_part().
    // outliers  of the bake's part where they are known; otherwise they are found
    PartMeter(const Asset& asset, size_t number, const BakeReader& bake,
              const std::optional<PositionOutliers>& outliers = {});

    // It holds kPosesMeasured poses at a time.
    SurfaceError surface(const LowRank& positions) const;

    // It holds one plane over all poses of bake, noise and asset at a time. Bands that the mesh does
    // not have are zero. Grey transfer is compared with every channel of a coloured bake.
    // mesh  with the topology of the part
    TransferError transfer(const CodedMesh& mesh, const BandPower& spectrum) const;

    MeshError measure(const CodedMesh& mesh, const BandPower& spectrum) const;

    // Memory of what it keeps.
    static uint64_t kept_bytes(uint64_t num_vertices, uint64_t num_triangles);

  private:
    std::vector<std::vector<float>> sample_poses() const;
    // Positions of pose p in the order of the file.
    void read_baked(uint32_t p, std::vector<float>& planes) const;

    const BakeReader& bake_;
    BakedPart baked_;
    std::vector<uint32_t> old_vertex_;  // [V] the vertex of the bake for each vertex of the file
    PositionOutliers outliers_;         // by vertices of the file
    uint32_t num_following_;            // vertices of the file, from the first
    ShapeNeighbours shape_;
};

// Measures all parts. Errors: those of PartMeter. It is also an error if asset or bake has a part
// that the other does not have.
AssetError measure_asset(const Asset& asset, const BakeReader& bake, const BandPower& spectrum);

// Poses whose positions are measured side by side.
constexpr uint32_t kPosesMeasured = 8;

// Planes [V][P] of floats that PartMeter::transfer() holds at once: baked, noise, decoded, and two
// more while it decodes.
constexpr uint64_t kPlanesMeasured = 5;

// Memory of PartMeter::measure() in addition to the asset and to what the meter keeps.
// num_components  of the transfer
// num_points, num_points_each  of codecs whose points are not the vertices, and of each of their
//                 groups (codec/point_groups.h); 0 for other codecs
uint64_t measure_part_bytes(uint64_t num_vertices, uint64_t num_poses, uint64_t num_components,
                            uint64_t num_points, uint64_t num_points_each);

// One number of an error, with its name in files and reports (docs/metrics.md).
struct NamedError {
    std::string name;
    double value = 0.0;
    bool of_light = false;  // whether it depends on the light's band power
};

// All errors that a file states, in the order of reports. Those of the still part are listed
// separately, because it must meet a target by itself.
std::vector<NamedError> named_errors(const AssetError& error);

// The errors that a file states: the member `measured` of its provenance.
struct ErrorStatement {
    std::string band_power;          // its name
    std::vector<NamedError> errors;  // those that the file states, in the order of named_errors()

    // The error of this name; nothing if the file does not state it.
    std::optional<double> value(std::string_view name) const;
};

// The JSON object of the member `measured`.
std::string error_statement_json(const AssetError& error, const BandPower& spectrum);

// Errors: bad input, naming the file, if it states no errors, or invalid ones.
ErrorStatement read_error_statement(const Asset& asset, const std::filesystem::path& file);

}  // namespace paim
