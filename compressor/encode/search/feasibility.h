// Targets that no file of a bake can meet.
#pragma once

#include "compressor/encode/search/problem.h"

namespace paim {

// Error (threshold exceeded): the bake's file for this error.
[[noreturn]] void throw_infeasible(const std::string& message);

// Refuses transfer errors below what noise and bands of the bake leave, with the best that there
// is.
void check_feasible(const EncodeProblem& problem, double transfer_error);

// The same of the error of the worst vertex to the bake.
void check_vertex_feasible(const EncodeProblem& problem, double vertex_error);

}  // namespace paim
