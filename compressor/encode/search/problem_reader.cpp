// Reads a bake for one target after another.
#include "compressor/encode/search/problem_reader.h"

#include <algorithm>
#include <utility>

#include "compressor/encode/data/bake_rows.h"
#include "compressor/encode/memory/memory_plan.h"
#include "compressor/encode/noise/rank_selection.h"
#include "compressor/encode/quantise/float_matrix.h"
#include "compressor/encode/search/transfer_encoder.h"
#include "paim/codec/codecs.h"
#include "paim/format/bake/baked_part.h"

namespace paim {

namespace {

std::shared_ptr<SearchProgress> begun(std::shared_ptr<SearchProgress> progress) {
    progress->begin("finding components", 0.35);
    return progress;
}

// Mean square of a pose's transfer, as if all that is dropped were in the band that weighs most.
double heaviest_energy(const EncodeProblem& problem) {
    double energy = 0.0, heaviest = 0.0;
    for (uint32_t l = 0; l < problem.layout.in_bands; ++l) {
        const double rms = problem.statistics.transfer_rms[l];
        const double weight = problem.spectrum.weight(l);
        energy += weight * (2.0 * l + 1.0) * problem.layout.channels *
                  problem.layout.num_outgoing() * rms * rms;
        heaviest = std::max(heaviest, weight);
    }
    return heaviest > 0.0 ? energy / heaviest : energy;
}

}  // namespace

ProblemReader::ProblemReader(const BakeReader& bake, const EncodeOptions& options,
                             const BandPower& spectrum, std::shared_ptr<SearchProgress> progress)
    : bake_(bake),
      options_(options),
      outliers_(find_outliers(BakedPart(bake, 0))),
      streamed_(with_outliers(encode_size(bake, options), outliers_)),
      in_flight_(choose_num_in_flight(streamed_, options.memory_bytes, bake.directory().string())),
      order_(cache_order(bake.topology())),
      problem_(
          start_problem(bake, options, spectrum, outliers_, order_, begun(std::move(progress)))),
      geometry_rows_(bake, outliers_),
      transfer_rows_(bake, problem_.layout.in_bands),
      parts_(decompose(geometry_rows_, transfer_rows_,
                       TransferRows(bake, problem_.layout.in_bands, TransferRows::Content::noise),
                       problem_.layout, in_flight_,
                       [&](double share) { problem_.progress->advance(share); })),
      shrinkage_(parts_.noise),
      positions_(bake, outliers_, geometry_rows_, parts_.geometry) {
    if (problem_.still_meter) {
        problem_.best_achievable.still =
            problem_.still_meter->measure(*problem_.shell.still(), problem_.spectrum);
    }
}

const EncodeProblem& ProblemReader::read(const EncodeTarget& target) {
    TargetSize size{streamed_, problem_.layout.num_planes()};
    size.transfer_components = transfer_components(target);
    size.codecs = searched_codecs(encoders_to_try(target.codec, options_.precision));
    read_positions(target, size);
    problem_.spare_bytes = options_.memory_bytes - target_held_bytes(size);
    problem_.unneeded_bytes = options_.memory_bytes - target_memory_bytes(size);
    read_transfer(size);
    problem_.progress->advance(0.4);
    return problem_;
}

uint32_t ProblemReader::transfer_components(const EncodeTarget& target) const {
    const double asked = asked_error(target);
    const double num_values =
        static_cast<double>(bake_.identity().num_vertices) * bake_.num_poses();
    return components_for(
        parts_.noise.num_above_noise,
        kDroppedShare * kDroppedShare * asked * asked * heaviest_energy(problem_) * num_values,
        [&](uint32_t k) { return parts_.noise.signal_of(static_cast<Eigen::Index>(k)); });
}

void ProblemReader::read_positions(const EncodeTarget& target, TargetSize& size) {
    positions_.aim_at(target);
    problem_.least_geometry_components = positions_.least_components();
    do {
        size.geometry_components = positions_.num_components();
        check_target_memory(size, searched_codecs(encoders_to_try("", options_.precision)),
                            options_.memory_bytes, bake_.directory().string());
        positions_.read(problem_, order_.old_vertex,
                        choose_target_in_flight(size, options_.memory_bytes));
    } while (positions_.need_more(problem_));
}

void ProblemReader::read_transfer(const TargetSize& size) {
    ScaledFactors& factors = problem_.transfer;
    if (!factors.mean.empty() && factors.num_components() == size.transfer_components) return;
    factors = {};  // first, so that there is memory
    factors = read_factors(transfer_rows_, parts_.transfer, size.transfer_components,
                           options_.noise == NoiseTreatment::shrink ? &shrinkage_ : nullptr,
                           order_.old_vertex, choose_target_in_flight(size, options_.memory_bytes));
    // No file of these components has a smaller error than they have as floats.
    CodedMesh best = problem_.shell.moving();
    best.transfer = plain_transfer(float_matrix(factors, factors.num_components(), Precision::f32));
    problem_.best_achievable.transfer = problem_.meter->transfer(best, problem_.spectrum);
    problem_.transfer_energy = 0.0;
    for (uint32_t l = 0; l < bake_.identity().layout.in_bands; ++l) {
        problem_.transfer_energy +=
            problem_.spectrum.weight(l) * problem_.best_achievable.transfer.bands[l].baked;
    }
}

}  // namespace paim
