// From an error to a file: the cheapest .paim that meets a target.
#include "compressor/encode/search/target_encode.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "compressor/encode/search/feasibility.h"
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
    PAIM_CHECK(target.transfer_error || target.size_bytes);
    remove_abandoned_versions(output);
    const EncodeProblem problem = read_problem(
        bake, options, target, std::make_shared<SearchProgress>(std::move(on_progress)));
    if (target.transfer_error) check_feasible(problem, *target.transfer_error);
    if (target.vertex_error) check_vertex_feasible(problem, *target.vertex_error);
    EncodedFiles files(problem, options, target);
    EncodedFile result = target.transfer_error
                             ? meet_error(problem, files, target, *target.transfer_error)
                             : fit_size(problem, files, *target.size_bytes);
    problem.progress->begin("writing", 1.0);
    result.file.write(output);
    problem.progress->advance(1.0);
    TargetSummary summary;
    summary.error = result.error;
    summary.best_achievable = problem.best_achievable.transfer.total();
    summary.targets = result.targets;
    summary.candidates = std::move(result.candidates);
    summary.geometry_components = result.geometry_components;
    summary.float_positions =
        is_integer(options.precision) && !is_integer(result.coding.positions.precision);
    summary.num_vertices = problem.geometry.num_points;
    summary.num_poses = bake.num_poses();
    summary.outliers = problem.outliers;
    summary.size_bytes = result.file.size_bytes();
    return summary;
}

}  // namespace paim
