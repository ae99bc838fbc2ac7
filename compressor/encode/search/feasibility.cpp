// What no file of a bake can meet.
#include "compressor/encode/search/feasibility.h"

#include <fmt/format.h>

#include "paim/base/error.h"

namespace paim {

void throw_missed(const std::string& message) {
    throw Error(ExitCode::threshold_exceeded, message);
}

namespace {

// whose  of the bake's parts has this floor
void check_floor(const EncodeProblem& problem, const TransferError& floor, const char* whose,
                 double transfer_error) {
    if (floor.total() < transfer_error) return;
    const std::string asked =
        fmt::format("{}: a transfer error of {:.3g} % is asked for, but {}",
                    problem.bake.directory().string(), 100.0 * transfer_error, whose);
    const uint32_t baked = problem.bake.identity().layout.bands;
    if (floor.missing_bands > floor.error) {
        throw_missed(fmt::format(
            "{}its {} bands leave out {:.3g} % of what light of this spectrum shows: the best is "
            "{:.3g} %; bake with more --bands",
            asked, baked, 100.0 * floor.missing_bands, 100.0 * floor.total()));
    }
    if (problem.layout.bands < baked) {
        throw_missed(fmt::format("{}{} of its {} bands leave {:.3g} % at best: keep more --bands",
                                 asked, problem.layout.bands, baked, 100.0 * floor.total()));
    }
    throw_missed(fmt::format("{}the bake's noise leaves {:.3g} % at best: bake with more --rays",
                             asked, 100.0 * floor.total()));
}

}  // namespace

void check_reachable(const EncodeProblem& problem, double transfer_error) {
    check_floor(problem, problem.floor.transfer, "", transfer_error);
    if (!problem.floor.scenery) return;
    check_floor(problem, problem.floor.scenery->transfer, "of the scenery ", transfer_error);
}

}  // namespace paim
