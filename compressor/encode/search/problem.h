// Everything about a bake that the search for settings compares them on.
#pragma once

#include <algorithm>
#include <memory>
#include <optional>
#include <vector>

#include "compressor/encode/options.h"
#include "compressor/encode/quantise/scaled_factors.h"
#include "compressor/encode/search/search_progress.h"
#include "paim/codec/surface_smoothing.h"
#include "paim/format/pack/plane_predictor.h"
#include "paim/mesh/cache_order.h"
#include "paim/mesh/outliers.h"
#include "paim/metrics/asset_error.h"

namespace paim {

struct EncodeProblem {
    const BakeReader& bake;
    TransferLayout layout;  // bands as asked for
    BandPower spectrum;
    PoseStatistics statistics;
    // Everything but textures, and but positions and transfer of the part that moves; vertices in
    // cache order.
    Asset shell = {};
    // [parts] They are large, and no candidate needs them: add_textures() is for files that are
    // written or whose size counts.
    std::vector<Texture> textures = {};
    PlanePredictor predictor = {};  // of the part that moves
    // What the parts are smoothed and measured on, made once.
    std::optional<SurfaceSmoother> smoother = {};  // of the part that moves
    std::optional<PartMeter> meter = {}, still_meter = {};
    ScaledFactors geometry = {},
                  transfer = {};  // as many components as can matter; without outliers and noise
    std::vector<double> plane_weight = {};  // [planes of layout] of squared transfer errors
    // Of these components, not quantised: no file of this bake has smaller errors.
    AssetError best_achievable = {};
    PositionOutliers outliers = {};       // by vertices of the bake
    PositionOutliers file_outliers = {};  // by vertices in cache order
    // Components of the geometry that every coding keeps, so that no vertex loses its motion.
    uint32_t least_geometry_components = 0;
    uint32_t num_face_vertices = 0;  // of the part that moves; the others count for nothing
    double transfer_energy = 0.0;    // weighted ‖y‖² of the whole bake
    uint64_t spare_bytes = 0;        // of options.memory_bytes, without what is held throughout
    uint64_t unneeded_bytes = 0;     // of these, without all that can be needed
    // Of all that is done with it; always there.
    std::shared_ptr<SearchProgress> progress = {};

    void add_textures(Asset& asset) const {
        for (size_t part = 0; part < textures.size(); ++part) {
            asset.parts[part].texture = textures[part];
        }
    }

    // Transfer error that noise and bands of the bake leave at best, in the part where it is
    // larger.
    double least_error() const {
        const double still = best_achievable.still ? best_achievable.still->transfer.total() : 0.0;
        return std::max(best_achievable.transfer.total(), still);
    }
};

// All but components and their errors. Bands, outliers and spectrum are set.
// order  of the vertices of the part that moves; the problem takes its topology
EncodeProblem start_problem(const BakeReader& bake, const EncodeOptions& options,
                            const BandPower& spectrum, PositionOutliers outliers, CacheOrder& order,
                            std::shared_ptr<SearchProgress> progress);

// The problem of one target (problem_reader.h is for several).
// Errors: unsupported, saying what is needed, if options.memory_bytes do not suffice for all that
// encode_to_target() does.
EncodeProblem read_problem(
    const BakeReader& bake, const EncodeOptions& options, const EncodeTarget& target,
    std::shared_ptr<SearchProgress> progress = std::make_shared<SearchProgress>());

}  // namespace paim
