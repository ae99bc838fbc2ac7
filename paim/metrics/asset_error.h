// A compressed animation, whatever its codec, against the bake it was made from.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "paim/codec/asset.h"
#include "paim/format/bake/bake_directory.h"
#include "paim/metrics/band_power.h"
#include "paim/metrics/geometry_error.h"
#include "paim/metrics/transfer_error.h"

namespace paim {

// Of one part. Transfer errors are relative to the part's own transfer, and the diagonal is its own.
struct MeshError {
    TransferError transfer;
    GeometryError geometry;
};

// Of the part that moves, and of the one that stands still, if there is one.
struct AssetError : MeshError {
    std::optional<MeshError> still;
};

// Decodes one part and measures it; a plane over all poses of bake, noise and asset is in memory at a
// time. Bands that the asset does not have count as zero; a grey asset of a coloured bake counts in
// every channel.
// number  of the part, in the asset and in the bake
// bake    verified (BakeReader::verify_all)
// Errors: bad input if the part is not of this bake, saying what differs.
MeshError measure_part(const Asset& asset, size_t number, const BakeReader& bake,
                       const BandPower& spectrum);

// The same of all parts. Errors, in addition: one of the two has a part that the other does not.
AssetError measure_asset(const Asset& asset, const BakeReader& bake, const BandPower& spectrum);

// Planes [V][P] of floats that measure_part() holds at once: of the bake, of its noise, and decoded, the
// last twice more while it is decoded.
constexpr uint64_t kPlanesMeasured = 5;

// Memory of measure_part() in addition to the asset.
// num_components  of the transfer
// num_points      of codecs whose points are not the vertices; 0 where they are
uint64_t measure_part_bytes(uint64_t num_vertices, uint64_t num_poses, uint64_t num_components,
                            uint64_t num_points, uint64_t num_threads);

// One figure of an error, by the name that files and reports have for it (docs/metrics.md).
struct NamedError {
    std::string name;
    double value = 0.0;
    bool of_light = false;  // depends on the light's spectrum
};

// All errors that a file states, in the order of reports. Those of the still part are listed on their
// own: it has to meet a target by itself.
std::vector<NamedError> named_errors(const AssetError& error);

// The errors that a file states: the member `measured` of its provenance.
struct ErrorStatement {
    std::string band_power;          // its name
    std::vector<NamedError> errors;  // only what is stated, in the order of named_errors()
};

// The member's JSON object.
std::string error_statement_json(const AssetError& error, const BandPower& spectrum);

// Errors: bad input, naming the file, if it states none or what it states makes no sense.
ErrorStatement read_error_statement(const Asset& asset, const std::filesystem::path& file);

}  // namespace paim
