// What a file has to meet: the error of the transfer, and three errors of the surface.
#pragma once

#include <limits>
#include <string>

#include "compressor/encode/options.h"
#include "paim/metrics/asset_error.h"

namespace paim {

// How good the positions of a part have to be. Distances see the size of errors; edges and normals
// see whether neighbours err alike, which is what one looks at.
struct SurfaceTarget {
    double distance = 0.0;          // RMS, scene units
    double sted = 0.0;              // of the worst piece
    double normal_angle_deg = 0.0;  // of the worst piece

    bool operator==(const SurfaceTarget&) const = default;
};

// What each part shall meet. Errors of the transfer are relative.
struct Targets {
    double transfer = 0.0;
    double worst_vertex = std::numeric_limits<double>::infinity();  // to the bake
    SurfaceTarget surface;

    bool operator==(const Targets&) const = default;
};

// What goes with this error of the transfer.
// diagonal  of the largest pose, scene units
Targets targets_of(const EncodeTarget& target, double transfer_error, double diagonal);

// The largest of the three measured errors, each relative to its target: good is at most 1. Not a
// number if an error is not.
double excess(const SurfaceError& measured, const SurfaceTarget& target);

// The error that the excess is of, in words, with the option that allows more of it:
// "an RMS distance of 2 is asked for, but positions as floats have 4 at best: allow a
// --geometry-error of 0.42 or more".
// best  of positions as floats; above the target
std::string missed_surface(const SurfaceError& best, const SurfaceTarget& target);

}  // namespace paim
