// What gloss loses because its frames come from decoded positions.
#pragma once

#include <cstdint>
#include <span>

#include "paim/codec/asset.h"
#include "paim/format/bake/bake_directory.h"
#include "paim/metrics/band_power.h"

namespace paim {

// Errors of transfer that is exact in its frames, in the axes of the pose: relative to its RMS over
// rows and poses.
struct FrameError {
    double relative_rms = 0.0;
    double worst_row = 0.0;  // RMS over the poses
};

// Turns the frames of all parts of a file (codec/gloss_frames.h) so that those of the first pose are the
// ones of the bake, whose z axes are baked normals.
// asset  codec/gloss_asset.h, made from the bake
// gloss  BakeReader::gloss()
void set_frame_turns(const BakeReader& gloss, Asset& asset);

// Compares frames of decoded positions, turned like that, with those of the bake, in all poses.
// part       0: the moving part; 1: the still part
// positions  of the file's part
// vertices   [R] the vertex of the file for each row of the bake
// power      weights bands of light
FrameError measure_frames(const BakeReader& gloss, size_t part, const LowRank& positions,
                          std::span<const uint32_t> vertices, const BandPower& power);

// Those of a file, as it has them, in the part where they are larger.
// asset  codec/gloss_asset.h, made from the bake
FrameError measure_frames(const BakeReader& gloss, const Asset& asset, const BandPower& power);

}  // namespace paim
