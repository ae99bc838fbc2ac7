// Which coding of both parts should meet a target, by estimates.
#include "compressor/encode/search/settings_search.h"

#include <fmt/format.h>

#include <algorithm>

#include "compressor/encode/search/target_words.h"

namespace paim {

std::optional<Coding> CodingSearch::choose(const Targets& targets,
                                           std::vector<Candidate>& candidates,
                                           std::string& reason) {
    problem_.progress->begin(
        fmt::format("comparing codings for {:.3g} %", 100.0 * targets.transfer), 0.8);
    const PositionCoding* const positions = positions_.choose(targets.surface);
    problem_.progress->advance(0.15);
    if (positions == nullptr) {
        reason = missed_positions(targets.surface);
        return std::nullopt;
    }
    Coding coding{*positions, {}};
    const double budget = transfer_budget(targets.transfer);
    const std::vector<TransferCoding> codings = search_.codings(budget);
    CodingLimits limits;
    // What saves bytes is not to play more slowly than what saves none, unless it is asked for.
    if (encoders_to_try(target_.codec, options_.precision).size() > 1) {
        limits.multiply_adds = plain_multiply_adds(problem_, budget);
    }
    if (target_.size_bytes && target_.transfer_error) {
        const uint64_t rest = coding.positions.bytes + estimated_overhead_bytes();
        limits.bytes = *target_.size_bytes > rest ? *target_.size_bytes - rest : 0;
    }
    const TransferCoding* best = best_coding(codings, target_.preference, limits);
    // What seems too large may still fit once it is squeezed.
    if (best == nullptr) best = best_coding(codings, Preference::size);
    if (best == nullptr) {
        reason = missed_transfer(targets.transfer);
        return std::nullopt;
    }
    candidates.clear();
    for (const TransferCoding& one : codings) {
        candidates.push_back(one.candidate);
        candidates.back().chosen = &one == best;
    }
    coding.transfer = *best;
    return coding;
}

// Squares that truncation and quantisation may add to what the best of the bake already errs.
double CodingSearch::transfer_budget(double target) const {
    const double best = problem_.best_achievable.transfer.total();
    return std::max(0.0, (target * target - best * best) * problem_.transfer_energy);
}

std::string CodingSearch::missed_positions(const SurfaceTarget& target) const {
    if (excess(problem_.best_achievable, target) <= 1.0) {
        return "positions as floats of 16 bits are not good enough: use --precision f32";
    }
    return missed_surface(problem_.best_achievable, target);
}

std::string CodingSearch::missed_transfer(double target) {
    const std::string asked =
        fmt::format("a {} of {:.3g} % ", target_words(problem_.layout).error, 100.0 * target);
    if (target_.decode_cost) {
        const auto least = search_.least_multiply_adds(transfer_budget(target));
        return asked +
               fmt::format("cannot be met with {} multiply-adds a vertex", *target_.decode_cost) +
               (least ? fmt::format("; with {} it can", *least) : "");
    }
    return asked + encoders_to_try(target_.codec, options_.precision).front()->words.missed;
}

// Triangles, colours, table, and the still part, whose integers take about an eighth of its floats.
uint64_t CodingSearch::estimated_overhead_bytes() const {
    const Asset& shell = problem_.shell;
    const uint64_t still =
        shell.still() == nullptr ? 0 : shell.still()->transfer->matrix.mean.size_bytes();
    return 2 * shell.moving().topology.triangles.size() + 4096 + still / 8;
}

}  // namespace paim
