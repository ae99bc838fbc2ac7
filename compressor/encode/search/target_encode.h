// From an error to a file: the cheapest .paim that meets a target, measured after everything.
#pragma once

#include <filesystem>

#include "compressor/encode/options.h"
#include "compressor/encode/search/search_progress.h"
#include "compressor/encode/search/targets.h"
#include "paim/mesh/outliers.h"

namespace paim {

struct TargetSummary {
    AssetError error;              // of the file, measured
    double best_achievable = 0.0;  // transfer error that no file of this bake is below
    Targets targets;               // that were met
    std::vector<Candidate> candidates;
    uint32_t geometry_components = 0;
    bool float_positions = false;  // where integers were asked for
    uint32_t num_vertices = 0, num_poses = 0;
    uint64_t size_bytes = 0;
    PositionOutliers outliers;  // of the bake, coded as exceptions

    const Candidate& chosen() const;
};

// Finds component counts, bands, steps and codec, writes the file, all or nothing, with the errors
// that were measured in its provenance ("measured").
// bake         verified (BakeReader::verify_all)
// on_progress  how far it is, whenever some of the work is done
// Errors: threshold exceeded, with the best that can be reached, if the target cannot; unsupported,
// saying what is needed, if options.memory_bytes are not enough; output failed; usage, if no
// encoder has the codec's name, or if it codes integers alone and options.precision is one of
// floats.
TargetSummary encode_to_target(const BakeReader& bake, const EncodeOptions& options,
                               const EncodeTarget& target, const std::filesystem::path& output,
                               SearchProgress::Listener on_progress = {});

}  // namespace paim
