// Positions from which gloss has its frames, good enough for its error.
#include "compressor/encode/search/frame_fit.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "compressor/encode/search/feasibility.h"
#include "paim/base/error.h"

namespace paim {

FramedSummary encode_for_frames(const EncodeTarget& target, double most,
                                const std::function<TargetSummary(const EncodeTarget&)>& encode,
                                const std::function<double()>& measure) {
    // Errors of frames grow about as angles of faces do. A little less than that is asked for, so that
    // one more try is mostly enough.
    constexpr double kLess = 0.9;
    constexpr int kMostTries = 8;
    EncodeTarget next = target;
    FramedSummary summary;
    for (int tries = 0; tries < kMostTries; ++tries) {
        try {
            summary.diffuse = encode(next);
        } catch (const Error& failure) {
            // What was asked for is possible; what frames would need is not.
            if (tries == 0 || failure.code() != ExitCode::threshold_exceeded) throw;
            break;
        }
        summary.frame_error = measure();
        if (summary.frame_error <= most) return summary;
        const double angle_deg = std::min(summary.diffuse.error.shape.worst.normal_angle_deg,
                                          summary.diffuse.targets.surface.normal_angle_deg);
        next.normal_angle_deg = kLess * angle_deg * most / summary.frame_error;
    }
    // Rounded up, as positions are coded otherwise for another error.
    const double enough = std::ceil(102.0 * summary.frame_error / kFrameShare);
    throw_infeasible(fmt::format(
        "frames of the gloss, from decoded positions, leave an error of {:.3g} %, expected at most {:.3g} %: {}. "
        "Where seams bend, normals of files are used, or the first pose has no area, frames are "
        "worse than positions",
        100.0 * summary.frame_error, 100.0 * most,
        enough < 100.0 ? fmt::format("allow a --max-gloss-error of {:.0f} % or more", enough)
                       : "no --max-gloss-error allows that"));
}

}  // namespace paim
