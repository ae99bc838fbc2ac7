// What no file of a bake can meet.
#include "compressor/encode/search/feasibility.h"

#include <fmt/format.h>

#include <string>

#include "compressor/encode/search/less_noise.h"
#include "paim/base/error.h"

namespace paim {

void throw_infeasible(const std::string& message) {
    throw Error(ExitCode::threshold_exceeded, message);
}

namespace {

// best   the smallest error that the part can have
// whose  part of the bake it is
void check_part(const EncodeProblem& problem, const TransferError& best, const char* whose,
                double transfer_error) {
    if (best.total() < transfer_error) return;
    const std::string asked =
        fmt::format("{}: a transfer error of {:.3g} % is asked for, but {}",
                    problem.bake.directory().string(), 100.0 * transfer_error, whose);
    const uint32_t baked = problem.bake.identity().layout.in_bands;
    if (best.missing_bands > best.error || best.missing_bands >= transfer_error) {
        const char* const more = best.error < transfer_error ? "" : " and more --rays";
        throw_infeasible(fmt::format(
            "{}its {} bands leave out {:.3g} % of what light of this spectrum shows: the best is "
            "{:.3g} %; bake with more --bands{}",
            asked, baked, 100.0 * best.missing_bands, 100.0 * best.total(), more));
    }
    if (problem.layout.in_bands < baked) {
        throw_infeasible(
            fmt::format("{}{} of its {} bands leave {:.3g} % at best: keep more --bands", asked,
                        problem.layout.in_bands, baked, 100.0 * best.total()));
    }
    throw_infeasible(fmt::format("{}the bake's noise leaves {:.3g} % at best: {}", asked,
                                 100.0 * best.total(),
                                 less_noise_hint(problem.bake.identity(), best, transfer_error)));
}

}  // namespace

void check_vertex_feasible(const EncodeProblem& problem, double vertex_error) {
    const double best = problem.best_achievable.transfer.worst_vertex_error_to_bake;
    if (best < vertex_error) return;
    throw_infeasible(fmt::format(
        "{}: a worst vertex of {:.3g} % is asked for, but one has {:.3g} % at best once noise is "
        "taken out: bake with more --rays, or allow a --max-vertex-error of {:.3g}% or more",
        problem.bake.directory().string(), 100.0 * vertex_error, 100.0 * best, 105.0 * best));
}

void check_feasible(const EncodeProblem& problem, double transfer_error) {
    check_part(problem, problem.best_achievable.transfer, "", transfer_error);
    if (!problem.best_achievable.still) return;
    check_part(problem, problem.best_achievable.still->transfer, "in the still meshes ",
               transfer_error);
}

}  // namespace paim
