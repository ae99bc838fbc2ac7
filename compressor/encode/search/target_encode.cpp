// From an error to a file: the cheapest .paim that meets a target.
#include "compressor/encode/search/target_encode.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "compressor/encode/search/feasibility.h"
#include "compressor/encode/search/grouped_file.h"
#include "compressor/encode/search/size_fit.h"
#include "paim/base/check.h"
#include "paim/base/file.h"

namespace paim {

namespace {

// Of this error, and of this size if one is asked for.
EncodedFile meet_error(const EncodeProblem& problem, EncodedFiles& files,
                       const EncodeTarget& target, double transfer_error) {
    std::string reason;
    std::optional<EncodedFile> file = files.meet(transfer_error, reason);
    if (!file) throw_missed(problem, transfer_error, reason);
    if (target.size_bytes && file->file.size_bytes() > *target.size_bytes) {
        throw_infeasible(
            fmt::format("{}: a transfer error of {:.3g} % takes {} bytes, --max-size allows {}",
                        problem.bake.directory().string(), 100.0 * transfer_error,
                        file->file.size_bytes(), *target.size_bytes));
    }
    return std::move(*file);
}

TargetSummary summarise(const EncodeProblem& problem, const EncodeOptions& options,
                        EncodedFile file) {
    TargetSummary summary;
    summary.error = file.error;
    summary.best_achievable = problem.best_achievable.transfer.total();
    summary.targets = file.targets;
    summary.candidates = std::move(file.candidates);
    summary.geometry_components = file.geometry_components;
    summary.float_positions =
        is_integer(options.precision) && !is_integer(file.coding.positions.precision);
    summary.num_vertices = problem.geometry.num_points;
    summary.num_poses = problem.bake.num_poses();
    summary.outliers = problem.outliers;
    summary.size_bytes = file.file.size_bytes();
    return summary;
}

// problem  of this target
TargetSummary encode_problem(const EncodeProblem& problem, const EncodeOptions& options,
                             const EncodeTarget& target, SearchMemo& memo,
                             const std::filesystem::path& output) {
    PAIM_CHECK(target.transfer_error || target.size_bytes);
    if (target.transfer_error) check_feasible(problem, *target.transfer_error);
    if (target.vertex_error) check_vertex_feasible(problem, *target.vertex_error);
    EncodedFiles files(problem, options, target, memo);
    EncodedFile result = target.transfer_error
                             ? meet_error(problem, files, target, *target.transfer_error)
                             : fit_size(problem, files, *target.size_bytes);
    problem.progress->begin("writing", 1.0);
    result.file.write(output);
    problem.progress->advance(1.0);
    return summarise(problem, options, std::move(result));
}

}  // namespace

const Candidate& TargetSummary::chosen() const {
    const auto found = std::find_if(candidates.begin(), candidates.end(),
                                    [](const Candidate& candidate) { return candidate.chosen; });
    PAIM_CHECK(found != candidates.end());
    return *found;
}

TargetSummary encode_to_target(const BakeReader& bake, const EncodeOptions& options,
                               const EncodeTarget& target, const std::filesystem::path& output,
                               SearchProgress::Listener on_progress) {
    remove_abandoned_versions(output);
    const EncodeProblem problem = read_problem(
        bake, options, target, std::make_shared<SearchProgress>(std::move(on_progress)));
    SearchMemo memo(problem, options.precision);
    return encode_problem(problem, options, target, memo, output);
}

TargetSeries::TargetSeries(const BakeReader& bake, EncodeOptions options, const BandPower& spectrum)
    : options_(std::move(options)),
      reader_(bake, options_, spectrum, std::make_shared<SearchProgress>()),
      memo_(reader_.problem(), options_.precision) {
    memo_.codecs.emplace();
}

void TargetSeries::prepare(const EncodeTarget& target) {
    const EncodeProblem& problem = reader_.read(target);
    const Held held{problem.transfer.num_components(), problem.geometry.num_components(),
                    problem.least_geometry_components};
    if (held.transfer != held_.transfer) memo_.codecs->clear();
    if (held.positions != held_.positions || held.least_positions != held_.least_positions) {
        memo_.positions.forget();
    }
    held_ = held;
}

TargetSummary TargetSeries::encode(const EncodeTarget& target,
                                   const std::filesystem::path& output) {
    prepare(target);
    return encode_problem(reader_.problem(), options_, target, memo_, output);
}

void TargetSeries::encode_groups(const EncodeTarget& target, const TransferEncoderType& type,
                                 uint32_t num_groups, const std::filesystem::path& output) {
    prepare(target);
    write_grouped_file(reader_.problem(), options_, target, type, num_groups, memo_, output);
}

double TargetSeries::least_error() {
    EncodeTarget smallest;  // as for a size
    smallest.spectrum = reader_.problem().spectrum;
    prepare(smallest);
    return reader_.problem().least_error();
}

}  // namespace paim
