// Which coding of both parts should meet a target, by estimates.
#include "compressor/encode/search/settings_search.h"

#include <fmt/format.h>

#include <algorithm>

#include "compressor/encode/search/part_search.h"

namespace paim {

Targets targets_of(const EncodeProblem& problem, const EncodeTarget& target,
                   double transfer_error) {
    const double relative =
        target.geometry_error.value_or(kGeometryPerTransferError * transfer_error);
    return {transfer_error, relative * problem.best_achievable.geometry.diagonal};
}

std::optional<Coding> CodingSearch::choose(const Targets& targets,
                                           std::vector<Candidate>& candidates,
                                           std::string& reason) {
    Coding coding;
    if (!choose_geometry(targets.geometry, coding)) {
        reason = fmt::format(
            "an RMS distance of {:.3g} needs positions of more than 16 bits: allow a larger "
            "--geometry-error, or use --precision f32",
            targets.geometry);
        return std::nullopt;
    }
    const std::vector<TransferCoding> codings = search_.codings(transfer_budget(targets.transfer));
    std::optional<uint64_t> most;
    if (target_.size_bytes && target_.transfer_error) {
        const uint64_t rest = coding.geometry_bytes + estimated_overhead_bytes();
        most = *target_.size_bytes > rest ? *target_.size_bytes - rest : 0;
    }
    const TransferCoding* best = best_coding(codings, target_.preference, most);
    // What seems too large may still fit once it is squeezed.
    if (best == nullptr) best = best_coding(codings, Preference::size, {});
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

bool CodingSearch::choose_geometry(double target, Coding& coding) const {
    const std::vector<double> alike(3, 1.0);
    const ScaledFactors& factors = problem_.geometry;
    const double most =
        target * target * static_cast<double>(problem_.num_face_vertices) * factors.num_poses();
    if (is_integer(options_.precision)) {
        // Vertices that no face has come last.
        auto choice = cheapest_part(part_choices(factors, alike, most, factors.num_components(),
                                                 problem_.predictor, problem_.num_face_vertices));
        if (!choice) return false;
        coding.geometry = std::move(choice->quantiser);
        coding.geometry_bytes = choice->bytes;
        return true;
    }
    const std::vector<double> tails = tail_errors(factors, alike);
    uint32_t k = 0;
    while (k + 1 < tails.size() && tails[k] > most) ++k;
    coding.geometry = {1.0, k, alike};
    coding.geometry_precision = options_.precision;
    const uint64_t value = options_.precision == Precision::f16 ? 2 : 4;
    coding.geometry_bytes = factors.mean.size() * (4 + k * value);
    return true;
}

std::string CodingSearch::missed_transfer(double target) {
    const std::string asked = fmt::format("a transfer error of {:.3g} % ", 100.0 * target);
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
