// Positions from which gloss has its frames, good enough for its error.
#pragma once

#include <functional>

#include "compressor/encode/search/target_encode.h"

namespace paim {

// The largest share of the error of gloss that its frames may have. The errors of frames and of
// coefficients do not depend on each other, so that their squares add up, and the coefficients have
// √(1 − share²) of the error left.
constexpr double kFrameShare = 0.5;

// A file of the diffuse transfer, and the relative error that gloss has from its positions.
struct FramedSummary {
    TargetSummary diffuse;
    double frame_error = 0.0;
};

// Encodes the diffuse transfer, with ever smaller angles of face normals until the error of the frames
// is at most `most`.
// encode   writes the file of a target
// measure  the error of the frames of the file that was written last
// Errors: threshold exceeded, if no positions are good enough.
FramedSummary encode_for_frames(const EncodeTarget& target, double most,
                                const std::function<TargetSummary(const EncodeTarget&)>& encode,
                                const std::function<double()>& measure);

}  // namespace paim
