// Encodes a .bake directory as a .paim file, row by row.
// Based on: Cardoso and Kry, Error Analysis of Precomputed Radiance Transfer for Deforming
// Geometry,
//           2012
#pragma once

#include <cmath>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>

#include "compressor/encode/decomposition.h"
#include "compressor/encode/options.h"
#include "paim/format/bake/bake_directory.h"
#include "paim/mesh/outliers.h"
#include "paim/metrics/asset_error.h"

namespace paim {

struct EncodeSummary {
    uint32_t geometry_components = 0;
    uint32_t transfer_components = 0;
    uint32_t geometry_rank = 0;
    uint32_t transfer_rank = 0;
    uint32_t bands = 0;
    double geometry_theory_error = 0.0;  // E5
    double transfer_theory_error = 0.0;
    double geometry_energy_error = 0.0;  // √(Σ dropped s² / Σ s²)
    double transfer_energy_error = 0.0;
    uint32_t transfer_above_noise = 0;   // components that stand out from the bake's noise
    double transfer_signal_error = 0.0;  // transfer_energy_error without the noise in either sum
    bool shrunk = false;
    // Expected error of the decoded transfer against one without noise, relative to the bake's
    // transfer in the bands that are kept.
    double expected_truncation_error = 0.0;
    double expected_noise_error = 0.0;
    double expected_error() const {
        return std::hypot(expected_truncation_error, expected_noise_error);
    }
    uint64_t size_bytes = 0;
    PositionOutliers outliers;           // of the bake, coded as exceptions
    std::optional<AssetError> measured;  // with EncodeOptions::measure; under flat light
};

// How many rows encode() reads: every row twice, and rows of the transfer and of its noise once
// more.
uint64_t num_rows_to_read(const BakeReader& bake, const EncodeOptions& options);

// Error (unsupported), saying what is needed, if options.memory_bytes are too few for this bake.
void check_memory(const BakeReader& bake, const EncodeOptions& options);

// Encodes and writes, all or nothing. Memory grows with P², the topology and V · bands, not with
// V · P. With options.measure the file is then measured against the bake and rewritten with its
// errors (state_errors.h), which holds the whole model in memory; if that fails to be written, the
// file stays complete, without its errors.
// bake     verified (BakeReader::verify_all)
// on_rows  called with a number of rows whenever they have been read, from any thread
// Errors: unsupported if options.memory_bytes are too few to encode, or to measure, before anything
// is written; bad input if the bake changes meanwhile; output failed.
EncodeSummary encode(const BakeReader& bake, const EncodeOptions& options,
                     const std::filesystem::path& output,
                     const std::function<void(uint64_t)>& on_rows = {});

// The same bytes, of components that were found before, for several files of one bake.
// parts  of all rows, without outliers, in the bands of the options
EncodeSummary encode(const BakeReader& bake, const EncodeOptions& options,
                     const Decomposition& parts, const std::filesystem::path& output);

}  // namespace paim
