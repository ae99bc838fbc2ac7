// What no file of a bake can meet.
#include "compressor/encode/search/feasibility.h"

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "compressor/bake/bake_options.h"
#include "compressor/encode/search/less_noise.h"
#include "compressor/encode/search/target_words.h"
#include "paim/base/check.h"
#include "paim/base/error.h"

namespace paim {

void throw_infeasible(const std::string& message) {
    throw Error(ExitCode::threshold_exceeded, message);
}

namespace {

// Error: more rays would help where `rays` are known.
[[noreturn]] void throw_noisy(const std::string& message, std::optional<uint32_t> rays) {
    if (!rays) throw_infeasible(message);
    throw TooNoisy(message, *rays);
}

// best   the smallest error that the part can have
// whose  part of the bake it is
void check_part(const EncodeProblem& problem, const TransferError& best, const char* whose,
                double transfer_error) {
    if (best.total() < transfer_error) return;
    const TargetWords words = target_words(problem.layout);
    const std::string asked =
        fmt::format("{}: a {} of {:.3g} % is asked for, but {}", problem.bake.directory().string(),
                    words.error, 100.0 * transfer_error, whose);
    const uint32_t baked = problem.bake.identity().layout.in_bands;
    if (best.missing_bands > best.error || best.missing_bands >= transfer_error) {
        const char* const more = best.error < transfer_error ? "" : " and more --rays";
        throw_infeasible(fmt::format(
            "{}its {} {} leave out {:.3g} % of what light of this spectrum shows: the best is "
            "{:.3g} %; bake with more {}{}",
            asked, baked, words.bands, 100.0 * best.missing_bands, 100.0 * best.total(),
            words.option, more));
    }
    if (problem.layout.in_bands < baked) {
        throw_infeasible(fmt::format("{}{} of its {} {} leave {:.3g} % at best: keep more --bands",
                                     asked, problem.layout.in_bands, baked, words.bands,
                                     100.0 * best.total()));
    }
    throw_noisy(
        fmt::format("{}the bake's noise leaves {:.3g} % at best: {}", asked, 100.0 * best.total(),
                    less_noise_hint(problem.bake.identity(), best, transfer_error)),
        rays_for(problem.bake.identity(), best, transfer_error));
}

// The error of the worst vertex, whose noise falls as that of all.
TransferError worst_vertex(const TransferError& error) {
    TransferError worst;
    worst.error = error.worst_vertex_error_to_bake;
    return worst;
}

}  // namespace

void check_vertex_feasible(const EncodeProblem& problem, double vertex_error) {
    const TransferError best = worst_vertex(problem.best_achievable.transfer);
    if (best.error < vertex_error) return;
    throw_noisy(
        fmt::format("{}: a worst vertex of {:.3g} % is asked for, but {} has {:.3g} % at best once "
                    "noise is taken out: bake with more --rays, or allow a --max-vertex-error of "
                    "{:.3g}% or more",
                    problem.bake.directory().string(), 100.0 * vertex_error,
                    target_words(problem.layout).of_vertex, 100.0 * best.error, 105.0 * best.error),
        rays_for(problem.bake.identity(), best, vertex_error));
}

void check_feasible(const EncodeProblem& problem, double transfer_error) {
    check_part(problem, problem.best_achievable.transfer, "", transfer_error);
    if (!problem.best_achievable.still) return;
    check_part(problem, problem.best_achievable.still->transfer, "in the still meshes ",
               transfer_error);
}

void throw_missed(const EncodeProblem& problem, double transfer_error, const std::string& reason) {
    const BakeIdentity& identity = problem.bake.identity();
    const auto rays = rays_for(identity, problem.best_achievable.transfer, transfer_error);
    throw_noisy(reason, rays && *rays > identity.rays ? rays : std::nullopt);
}

uint32_t rays_to_meet(const EncodeProblem& problem, const EncodeTarget& target) {
    PAIM_CHECK(target.transfer_error.has_value());
    const AssetError& best = problem.best_achievable;
    std::vector<std::pair<TransferError, double>> wanted{{best.transfer, *target.transfer_error}};
    if (best.still) wanted.emplace_back(best.still->transfer, *target.transfer_error);
    if (target.vertex_error) {
        wanted.emplace_back(worst_vertex(best.transfer), *target.vertex_error);
    }
    uint32_t most = 0;
    for (const auto& [error, allowed] : wanted) {
        const auto rays = rays_for(problem.bake.identity(), error, allowed);
        if (!rays) {
            check_feasible(problem, *target.transfer_error);
            if (target.vertex_error) check_vertex_feasible(problem, *target.vertex_error);
        }
        most = std::max(most, rays.value_or(kMostRays));
    }
    return most;
}

}  // namespace paim
