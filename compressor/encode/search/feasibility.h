// Targets that no file of a bake can meet.
#pragma once

#include <cstdint>
#include <string>

#include "compressor/encode/search/problem.h"

namespace paim {

// Error (threshold exceeded): the bake's file for this error.
[[noreturn]] void throw_infeasible(const std::string& message);

// Refuses transfer errors below what noise and bands of the bake leave, with the best that there
// is. Where noise is in the way and more rays would do, the error is TooNoisy (less_noise.h).
void check_feasible(const EncodeProblem& problem, double transfer_error);

// The same of the error of the worst vertex to the bake.
void check_vertex_feasible(const EncodeProblem& problem, double vertex_error);

// Error (threshold exceeded) with this reason: no file was found for a transfer error that is
// feasible. TooNoisy, if noise takes so much of it that little is left for coding.
[[noreturn]] void throw_missed(const EncodeProblem& problem, double transfer_error,
                               const std::string& reason);

// How many rays a vertex should do for a target with a transfer error, by the noise of this bake,
// which has a fixed count of rays. Error (threshold exceeded): more rays would not help, or not even
// kMostRays would do.
uint32_t rays_to_meet(const EncodeProblem& problem, const EncodeTarget& target);

}  // namespace paim
