// Error of the change from pose to pose, which is seen as flicker.
#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "analysis/file_poses.h"
#include "analysis/stage.h"
#include "paim/format/bake/bake_directory.h"

namespace paim {

// Of one light. With I the radiance of all vertices as baked, Î as decoded and Δ a step to the next
// pose:
struct Flicker {
    double error_sum = 0.0;     // Σ |ΔÎ − ΔI|
    double change_sum = 0.0;    // Σ |ΔI|
    double radiance_sum = 0.0;  // Σ |I| of the later pose
    double noise_sum = 0.0;     // Σ |Δ| of the radiance of the bake's noise
    // [P − 1] Σ |ΔÎ − ΔI| / Σ |I| of each step; not a number where all is black
    std::vector<double> of_step;
    uint32_t worst_step = 0;  // from this pose to the next

    // Relative to what changes: infinite if nothing changes as baked, 0 if nothing does as decoded
    // either. Not a number without steps.
    double of_change() const;
    // Relative to the radiance. Not a number if all is black, or without steps.
    double of_radiance() const;
    // What the bake's own noise changes from pose to pose, relative to what changes. A file without this
    // noise differs from the bake by as much.
    double noise_of_change() const;
};

// Follows all poses. Two are in memory at a time.
// file     made from this bake
// on_pose  called after each pose
// returns  [lights]
std::vector<Flicker> measure_flicker(const BakeReader& bake, FilePoses& file, const Stage& stage,
                                     const std::function<void()>& on_pose);

}  // namespace paim
