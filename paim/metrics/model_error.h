// A compressed animation, whatever its codec, against the bake it was made from.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "paim/codec/model.h"
#include "paim/format/bake/bake_directory.h"
#include "paim/metrics/band_power.h"
#include "paim/metrics/geometry_error.h"
#include "paim/metrics/scenery_error.h"
#include "paim/metrics/transfer_error.h"

namespace paim {

struct ModelError {
    TransferError transfer;
    GeometryError geometry;
    std::optional<SceneryError> scenery;  // none: there is no scenery
};

// Decodes and measures everything that the model holds but scenery; a plane over all poses of bake,
// noise and model is in memory at a time. Bands that the model does not have count as zero; a grey
// model of a coloured bake counts in every channel.
// bake  verified (BakeReader::verify_all)
// Errors: bad input if the model is not of this bake, saying what differs.
ModelError measure_animation(const Model& model, const BakeReader& bake, const BandPower& spectrum);

// The same with the scenery, where there is any.
ModelError measure_model(const Model& model, const BakeReader& bake, const BandPower& spectrum);

// Planes [V][P] of floats that measure_animation() holds at once: of the bake, of its noise, and
// decoded, the last twice more while it is decoded.
constexpr uint64_t kPlanesMeasured = 5;

// Memory of measure_animation() in addition to the model, for codec svd, and for cpca with the rows
// of the bases of all clusters.
// num_components  of the transfer
uint64_t measure_animation_bytes(uint64_t num_vertices, uint64_t num_poses, uint64_t num_components,
                                 uint64_t num_basis_rows, uint64_t num_threads);

// One figure of an error, by the name that files and reports have for it (docs/metrics.md).
struct NamedError {
    std::string name;
    double value = 0.0;
    bool of_light = false;  // depends on the light's spectrum
};

// All that a file states of its errors, in the order of reports. The scenery's are apart: it has a
// target's errors of its own.
std::vector<NamedError> named_errors(const ModelError& error);

// What a file says of its errors: the member `measured` of its provenance.
struct ErrorStatement {
    std::string band_power;          // its name
    std::vector<NamedError> errors;  // only what is stated, in the order of named_errors()
};

// The member's JSON object.
std::string error_statement_json(const ModelError& error, const BandPower& spectrum);

// Errors: bad input, naming the file, if it states none or what it states makes no sense.
ErrorStatement read_error_statement(const Model& model, const std::filesystem::path& file);

}  // namespace paim
