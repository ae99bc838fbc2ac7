// Files of a given number of groups of vertices.
#include "compressor/encode/search/grouped_file.h"

#include <fmt/format.h>

#include "compressor/encode/data/provenance.h"
#include "compressor/encode/search/feasibility.h"
#include "compressor/encode/search/held_positions.h"
#include "paim/base/check.h"
#include "paim/format/paim/packed_file.h"

namespace paim {

namespace {

const RefinedPositions& positions_within(const EncodeProblem& problem, PositionFinder& positions,
                                         const SurfaceTarget& target) {
    const PositionCoding* const coding = positions.choose(target);
    const RefinedPositions* const refined =
        coding == nullptr ? nullptr : positions.refine(*coding, target);
    if (refined == nullptr) {
        throw_infeasible(fmt::format("{}: {}", problem.bake.directory().string(),
                                     missed_surface(problem.best_achievable, target)));
    }
    return *refined;
}

}  // namespace

void write_grouped_file(const EncodeProblem& problem, const EncodeOptions& options,
                        const EncodeTarget& target, const TransferEncoderType& type,
                        uint32_t num_groups, SearchMemo& memo,
                        const std::filesystem::path& output) {
    PAIM_CHECK(type.code_groups != nullptr);
    const Targets targets =
        targets_of(target, asked_error(target), problem.best_achievable.geometry.diagonal);
    Asset asset = problem.shell;
    if (const QuantisedStill still = exact_still(problem); still.mesh) *asset.still() = *still.mesh;
    CodedMesh& mesh = asset.moving();
    mesh.positions = positions_within(problem, memo.positions, targets.surface).matrix;
    mesh.transfer = type.code_groups(
        {problem, options, target, memo.codecs ? &*memo.codecs : nullptr}, num_groups);
    asset.provenance_json = bake_provenance(problem.bake.identity(), problem.statistics);
    problem.add_textures(asset);
    PackedFile(asset).write(output);
}

}  // namespace paim
