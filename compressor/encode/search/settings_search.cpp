// Which coding of both parts should meet a target, by estimates.
#include "compressor/encode/search/settings_search.h"

#include <fmt/format.h>

#include <algorithm>

#include "compressor/encode/search/part_search.h"

namespace paim {

namespace {

// An RMS distance as a sum of squares over the vertices of faces and all poses.
double squared_distances(const EncodeProblem& problem, double rms) {
    return rms * rms * static_cast<double>(problem.num_face_vertices) *
           problem.geometry.num_poses();
}

// With the fewest components whose rest is at most `most_error`, a sum of squares.
void code_positions_as_floats(const EncodeProblem& problem, double most_error, Precision precision,
                              Coding& coding) {
    const std::vector<double> alike(3, 1.0);
    const std::vector<double> tails = tail_errors(problem.geometry, alike);
    uint32_t k = problem.least_geometry_components;
    while (k + 1 < tails.size() && tails[k] > most_error) ++k;
    coding.geometry = {1.0, k, alike};
    coding.geometry_precision = precision;
    const uint64_t value = precision == Precision::f16 ? 2 : 4;
    coding.geometry_bytes = problem.geometry.mean.size() * (4 + k * value);
}

}  // namespace

bool use_float_positions(const EncodeProblem& problem, double distance, Coding& coding) {
    const GeometryError& best = problem.best_achievable.geometry;
    if (!(best.rms() <= distance)) return false;
    // What rounding to floats and components that were dropped before take is spent already.
    const double room = squared_distances(problem, distance) - best.distance.squared_sum;
    code_positions_as_floats(problem, room, Precision::f32, coding);
    return true;
}

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
        reason = missed_geometry(targets.geometry);
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
    const double most = squared_distances(problem_, target);
    if (!is_integer(options_.precision)) {
        if (!(problem_.best_achievable.geometry.rms() <= target)) return false;
        code_positions_as_floats(problem_, most, options_.precision, coding);
        return true;
    }
    const std::vector<double> alike(3, 1.0);
    const ScaledFactors& factors = problem_.geometry;
    // Vertices that no face has come last.
    auto choice = cheapest_part(part_choices(factors, alike, most, factors.num_components(),
                                             problem_.predictor, problem_.num_face_vertices,
                                             problem_.least_geometry_components));
    if (!choice) return use_float_positions(problem_, target, coding);
    coding.geometry = std::move(choice->quantiser);
    coding.geometry_bytes = choice->bytes;
    return true;
}

std::string CodingSearch::missed_geometry(double target) const {
    const GeometryError& best = problem_.best_achievable.geometry;
    const double allowed = 1.05 * best.relative_rms();
    const std::string missed = fmt::format(
        "an RMS distance of {:.3g} is asked for, but positions as floats have {:.3g} at best",
        target, best.rms());
    if (allowed < 1.0) {
        return missed + fmt::format(": allow a --geometry-error of {:.3g} or more", allowed);
    }
    // Poses that are points, or much farther apart than they are large.
    return missed + fmt::format(
                        ", and the diagonal of the largest pose is {:.3g}: bring the poses nearer "
                        "together, or encode without --max-error and --max-size",
                        best.diagonal);
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
