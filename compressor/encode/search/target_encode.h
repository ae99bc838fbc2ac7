// From an error to a file: the cheapest .paim that meets a target, measured after everything.
#pragma once

#include <filesystem>

#include "compressor/encode/options.h"
#include "compressor/encode/search/problem_reader.h"
#include "compressor/encode/search/search_memo.h"
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

// Files of one bake for one target after another. Each has the bytes that encode_to_target() writes
// for its target, whatever was encoded before, and is found sooner: components are found once, they
// are read again where another error needs another number of them, and positions and what codecs
// keep (CodecMemo) stay while the components do.
// It takes more memory than options.memory_bytes: the noise of the components, and what stays.
class TargetSeries {
  public:
    // Keeps a reference to the bake.
    // spectrum  of all targets
    TargetSeries(const BakeReader& bake, EncodeOptions options, const BandPower& spectrum);

    // Reads what the target needs, so that encode() takes its own time alone.
    void prepare(const EncodeTarget& target);

    // Errors: as encode_to_target()
    TargetSummary encode(const EncodeTarget& target, const std::filesystem::path& output);

    // The file of a given number of groups instead (grouped_file.h). Positions meet the target.
    void encode_groups(const EncodeTarget& target, const TransferEncoderType& type,
                       uint32_t num_groups, const std::filesystem::path& output);

    // No file of these bands has a smaller error of the transfer than this: noise of the bake and
    // bands that are not kept leave it.
    double least_error();

    // All components in its bands, for files without a target (encode.h).
    const Decomposition& decomposition() const { return reader_.decomposition(); }

  private:
    const EncodeOptions options_;
    ProblemReader reader_;
    SearchMemo memo_;
    // Numbers of components that the memo belongs to.
    struct Held {
        uint32_t transfer = 0, positions = 0, least_positions = 0;
    } held_;
};

}  // namespace paim
