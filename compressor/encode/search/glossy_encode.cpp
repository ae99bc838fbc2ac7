// From a target to a file with diffuse and glossy transfer.
#include "compressor/encode/search/glossy_encode.h"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <optional>
#include <utility>
#include <vector>

#include "compressor/encode/search/feasibility.h"
#include "compressor/encode/search/size_search.h"
#include "paim/base/check.h"
#include "paim/base/error.h"
#include "paim/base/json_text.h"
#include "paim/codec/gloss_asset.h"
#include "paim/format/paim/paim_read.h"
#include "paim/format/paim/paim_write.h"

namespace paim {

namespace {

namespace fs = std::filesystem;

// The vertices of a part of the whole that the vertices of the same part of the gloss are.
std::vector<uint32_t> rows_in_whole(const Asset& whole, const Asset& gloss, size_t part,
                                    const BakeReader& bake, const BakeReader& gloss_bake,
                                    const std::vector<uint32_t>& rows) {
    const std::vector<uint32_t> of_whole = match_part(whole, part, bake);
    std::vector<uint32_t> new_number(of_whole.size());
    for (uint32_t v = 0; v < of_whole.size(); ++v) new_number[of_whole[v]] = v;
    std::vector<uint32_t> vertices = match_part(gloss, part, gloss_bake);
    for (uint32_t& vertex : vertices) vertex = new_number[rows[vertex]];
    return vertices;
}

// Takes what a file of gloss alone states of its positions, and met for them, out of its provenance: the
// file of both kinds has the positions of the diffuse one.
void forget_positions(const fs::path& file, Asset& gloss) {
    auto provenance = nlohmann::json::parse(gloss.provenance_json);
    if (!provenance.contains("measured")) return;
    for (const NamedError& error : read_error_statement(gloss, file).errors) {
        if (error.of_light) continue;
        for (const char* const member : {"measured", "targets"}) {
            if (provenance.contains(member)) provenance[member].erase(error.name);
        }
    }
    gloss.provenance_json = json_text(provenance);
}

// The files of one error for both kinds of transfer.
class JoinedFiles : public SizedFiles {
  public:
    JoinedFiles(const BakeReader& bake, const BakeReader& gloss, const EncodeOptions& options,
                const GlossyTarget& target, const fs::path& scratch)
        : bake_(bake),
          target_(target),
          scratch_(scratch),
          diffuse_(bake, options, target.diffuse.spectrum),
          gloss_(gloss, options, target.gloss.spectrum) {}

    double least_error() { return std::max(diffuse_.least_error(), gloss_.least_error()); }

    std::optional<uint64_t> estimated_bytes(double error) override { return make(error); }

    std::optional<uint64_t> make(double error) override {
        if (made_ && error_ == error) return made_->size_bytes;
        made_.reset();
        error_ = error;
        EncodeTarget diffuse = target_.diffuse, gloss = target_.gloss;
        diffuse.size_bytes.reset();
        gloss.size_bytes.reset();
        diffuse.transfer_error = gloss.transfer_error = error;
        const TransferFiles files{scratch_ / "diffuse.paim", scratch_ / "gloss.paim"};
        try {
            GlossySummary summary{diffuse_.encode(diffuse, files.diffuse),
                                  gloss_.encode(gloss, files.gloss), 0};
            summary.size_bytes = join_transfer_files(bake_, files, scratch_ / "made.paim");
            made_ = std::move(summary);
        } catch (const Error& failure) {
            if (failure.code() != ExitCode::threshold_exceeded) throw;
            return std::nullopt;
        }
        return made_->size_bytes;
    }

    void keep() override {
        best_ = made_;
        fs::rename(scratch_ / "made.paim", best_path());
    }

    fs::path best_path() const { return scratch_ / "best.paim"; }
    GlossySummary best() const { return *best_; }
    std::optional<uint64_t> last_bytes() const {
        return made_ ? std::optional(made_->size_bytes) : std::nullopt;
    }

  private:
    const BakeReader& bake_;
    const GlossyTarget& target_;
    const fs::path scratch_;
    TargetSeries diffuse_, gloss_;
    double error_ = 0.0;
    std::optional<GlossySummary> made_, best_;
};

GlossySummary fit_both(const BakeReader& bake, const BakeReader& gloss,
                       const EncodeOptions& options, const GlossyTarget& target,
                       const fs::path& scratch, const fs::path& output,
                       const GlossyListener& on_step) {
    constexpr double kLargestError = 0.5;
    const uint64_t most_bytes = *target.diffuse.size_bytes;
    JoinedFiles files(bake, gloss, options, target, scratch);
    if (on_step) on_step("both", "fitting the size", 0.5);
    const double least_error = std::min(kLargestError, 1.02 * std::max(1e-4, files.least_error()));
    if (!find_smallest_error(files, least_error, kLargestError, most_bytes)) {
        const std::optional<uint64_t> bytes = files.make(kLargestError);
        throw_infeasible(fmt::format(
            "{}: --max-size asks for {} bytes; with errors of {:.0f} % of transfer and gloss {}",
            bake.directory().string(), most_bytes, 100.0 * kLargestError,
            bytes ? fmt::format("it takes {}", *bytes) : "there is no file"));
    }
    write_paim(output, read_paim(files.best_path()));
    return files.best();
}

}  // namespace

uint64_t join_transfer_files(const BakeReader& bake, const TransferFiles& files,
                             const fs::path& output) {
    Asset whole = read_paim(files.diffuse);
    ReadOptions glossy;
    glossy.kind = TransferKind::glossy;
    Asset gloss = read_paim(files.gloss, glossy);
    const BakeReader gloss_bake = bake.gloss();
    const std::vector<uint32_t> vertices =
        rows_in_whole(whole, gloss, 0, bake, gloss_bake, bake.gloss_rows());
    std::vector<uint32_t> still;
    if (gloss.still() != nullptr) {
        const BakedStillMesh& mesh = bake.still_mesh().value();
        still = rows_in_whole(whole, gloss, 1, bake, gloss_bake,
                              glossy_rows(mesh.topology, mesh.materials));
    }
    forget_positions(files.gloss, gloss);
    join_gloss(std::move(gloss), vertices, still, whole);
    write_paim(output, whole);
    return fs::file_size(output);
}

GlossySummary encode_glossy_to_target(const BakeReader& bake, const EncodeOptions& options,
                                      const GlossyTarget& target, const fs::path& scratch,
                                      const fs::path& output, const GlossyListener& on_step) {
    PAIM_CHECK(!bake.gloss_rows().empty());
    const BakeReader gloss = bake.gloss();
    if (!target.diffuse.transfer_error) {
        return fit_both(bake, gloss, options, target, scratch, output, on_step);
    }
    PAIM_CHECK(target.gloss.transfer_error.has_value());
    const auto listener = [&](const char* part) -> SearchProgress::Listener {
        if (!on_step) return {};
        return
            [part, &on_step](const std::string& step, double done) { on_step(part, step, done); };
    };
    EncodeTarget of_gloss = target.gloss;
    of_gloss.size_bytes.reset();
    const TransferFiles files{scratch / "diffuse.paim", scratch / "gloss.paim"};
    GlossySummary summary;
    summary.diffuse =
        encode_to_target(bake, options, target.diffuse, files.diffuse, listener("diffuse"));
    summary.gloss = encode_to_target(gloss, options, of_gloss, files.gloss, listener("gloss"));
    summary.size_bytes = join_transfer_files(bake, files, scratch / "made.paim");
    if (target.diffuse.size_bytes && summary.size_bytes > *target.diffuse.size_bytes) {
        throw_infeasible(fmt::format(
            "{}: a transfer error of {:.3g} % and a gloss error of {:.3g} % take {} "
            "bytes, --max-size allows {}",
            bake.directory().string(), 100.0 * *target.diffuse.transfer_error,
            100.0 * *of_gloss.transfer_error, summary.size_bytes, *target.diffuse.size_bytes));
    }
    write_paim(output, read_paim(scratch / "made.paim"));
    return summary;
}

}  // namespace paim
