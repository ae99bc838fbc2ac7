// From a target to a file with diffuse and glossy transfer.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>

#include "compressor/encode/search/target_encode.h"
#include "paim/metrics/frame_error.h"

namespace paim {

// The files of the diffuse and of the glossy transfer of a bake, from which a file of both is made.
struct TransferFiles {
    std::filesystem::path diffuse, gloss;
};

struct JoinedFile {
    uint64_t size_bytes = 0;
    FrameError frames;  // of the gloss, in the part where it is larger; stated in the file
};

// Joins them. The file is written completely or not at all.
// bake   that both were made from
// power  weights errors of frames
// Errors: those of reading and writing.
JoinedFile join_transfer_files(const BakeReader& bake, const TransferFiles& files,
                               const BandPower& power, const std::filesystem::path& output);

struct GlossySummary {
    TargetSummary diffuse, gloss;
    JoinedFile both;
    // The error of the gloss: √(coefficients² + frames²).
    double gloss_error() const;
};

struct GlossyTarget {
    // Of the diffuse transfer; the size is that of the file of both.
    EncodeTarget diffuse;
    // Of the gloss. Its error is relative to the glossy transfer alone, and covers that of the frames,
    // which positions are made good enough for (frame_fit.h). Its size is not used. It has an
    // error if the diffuse target has one (checked).
    EncodeTarget gloss;
};

// Encodes both, each by itself, so that each meets its target. For a size alone, both have the same
// error, which is the smallest whose file fits, to 2 % of it or less.
// bake     with glossy rows (checked), verified
// scratch  an empty directory for files of the parts
// on_step  called with "diffuse", "gloss" or "both", what is being done, and how far that part is (0 … 1)
// Errors: those of encode_to_target().
using GlossyListener = std::function<void(const char* part, const std::string& step, double done)>;
GlossySummary encode_glossy_to_target(const BakeReader& bake, const EncodeOptions& options,
                                      const GlossyTarget& target,
                                      const std::filesystem::path& scratch,
                                      const std::filesystem::path& output,
                                      const GlossyListener& on_step = {});

}  // namespace paim
