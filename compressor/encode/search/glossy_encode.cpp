// From a target to a file with diffuse and glossy transfer.
#include "compressor/encode/search/glossy_encode.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <optional>
#include <utility>
#include <vector>

#include "compressor/encode/search/feasibility.h"
#include "compressor/encode/search/frame_fit.h"
#include "compressor/encode/search/less_noise.h"
#include "compressor/encode/search/size_search.h"
#include "paim/base/check.h"
#include "paim/base/error.h"
#include "paim/base/file.h"
#include "paim/base/json_text.h"
#include "paim/codec/gloss_asset.h"
#include "paim/format/paim/paim_read.h"
#include "paim/format/paim/paim_write.h"

namespace paim {

namespace {

namespace fs = std::filesystem;

// [V] The vertex of a part of the file for each vertex of the bake.
std::vector<uint32_t> vertices_of_bake(const Asset& whole, size_t part, const BakeReader& bake) {
    const std::vector<uint32_t> of_whole = match_part(whole, part, bake);
    std::vector<uint32_t> new_number(of_whole.size());
    for (uint32_t v = 0; v < of_whole.size(); ++v) new_number[of_whole[v]] = v;
    return new_number;
}

// [R] The vertex of a part of the file for each row of gloss of the bake.
std::vector<uint32_t> vertices_of_rows(const Asset& whole, size_t part, const BakeReader& bake) {
    const std::vector<uint32_t> new_number = vertices_of_bake(whole, part, bake);
    std::vector<uint32_t> rows =
        part == 0 ? bake.gloss_rows()
                  : glossy_rows(bake.still_mesh()->topology, bake.still_mesh()->materials);
    for (uint32_t& row : rows) row = new_number[row];
    return rows;
}

// Of the part where it is largest.
FrameError measure_frames(const Asset& whole, const BakeReader& bake, const BakeReader& gloss,
                          const BandPower& power) {
    FrameError worst;
    for (size_t part = 0; part < num_baked_parts(gloss); ++part) {
        const FrameError error = measure_frames(gloss, part, whole.parts[part].positions,
                                                vertices_of_rows(whole, part, bake), power);
        if (error.relative_rms >= worst.relative_rms) worst = error;
    }
    return worst;
}

// How to encode one kind of transfer.
using Encoder = std::function<TargetSummary(const EncodeTarget&, const fs::path&)>;

// Encodes both with the errors of the target, and joins them.
GlossySummary encode_both(const BakeReader& bake, const BakeReader& gloss,
                          const GlossyTarget& target, const Encoder& encode_diffuse,
                          const Encoder& encode_gloss, const fs::path& scratch,
                          const fs::path& output) {
    const TransferFiles files{scratch / "diffuse.paim", scratch / "gloss.paim"};
    const double error = *target.gloss.transfer_error;
    const FramedSummary framed = encode_for_frames(
        target.diffuse, kFrameShare * error,
        [&](const EncodeTarget& diffuse) { return encode_diffuse(diffuse, files.diffuse); },
        [&] {
            return measure_frames(read_paim(files.diffuse), bake, gloss, target.gloss.spectrum)
                .relative_rms;
        });
    EncodeTarget of_gloss = target.gloss;
    of_gloss.transfer_error = std::sqrt(error * error - framed.frame_error * framed.frame_error);
    const auto encode_coefficients = [&] {
        const auto with_frames = [&](const Error& failure) {
            return fmt::format(
                "{} (of {:.3g} %, frames from decoded positions take {:.3g} %: squares add "
                "up)",
                failure.what(), 100.0 * error, 100.0 * framed.frame_error);
        };
        try {
            return encode_gloss(of_gloss, files.gloss);
        } catch (const TooNoisy& noisy) {
            throw TooNoisy(with_frames(noisy), noisy.rays());
        } catch (const Error& failure) {
            if (failure.code() != ExitCode::threshold_exceeded) throw;
            throw Error(failure.code(), with_frames(failure));
        }
    };
    GlossySummary summary{framed.diffuse, encode_coefficients(), {}};
    summary.both = join_transfer_files(bake, files, target.gloss.spectrum, output);
    return summary;
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
                const GlossyTarget& target, const fs::path& scratch, SearchProgress& progress)
        : bake_(bake),
          gloss_bake_(gloss),
          target_(target),
          scratch_(scratch),
          progress_(progress),
          diffuse_(bake, options, target.diffuse.spectrum),
          gloss_(gloss, options, target.gloss.spectrum) {}

    double least_error() { return std::max(diffuse_.least_error(), gloss_.least_error()); }

    std::optional<uint64_t> estimated_bytes(double error) override { return make(error); }

    std::optional<uint64_t> make(double error) override {
        if (made_ && error_ == error) return made_->both.size_bytes;
        made_.reset();
        error_ = error;
        EncodeTarget diffuse = target_.diffuse, gloss = target_.gloss;
        diffuse.size_bytes.reset();
        gloss.size_bytes.reset();
        diffuse.transfer_error = gloss.transfer_error = error;
        // Where positions have to be better for the frames, files of the diffuse transfer count again.
        const auto with = [this](TargetSeries& series) {
            return [this, &series](const EncodeTarget& of, const fs::path& path) {
                TargetSummary summary = series.encode(of, path);
                progress_.advance(kShareOfAFile);
                return summary;
            };
        };
        progress_.begin(fmt::format("fitting the size, error {:.3g} %", 100.0 * error), kFitted);
        try {
            made_ = encode_both(bake_, gloss_bake_, {diffuse, gloss}, with(diffuse_), with(gloss_),
                                scratch_, scratch_ / "made.paim");
        } catch (const Error& failure) {
            if (failure.code() != ExitCode::threshold_exceeded) throw;
            return std::nullopt;
        }
        return made_->both.size_bytes;
    }

    void keep() override {
        best_ = made_;
        fs::rename(scratch_ / "made.paim", best_path());
    }

    fs::path best_path() const { return scratch_ / "best.paim"; }
    GlossySummary best() const { return *best_; }
    std::optional<uint64_t> last_bytes() const {
        return made_ ? std::optional(made_->both.size_bytes) : std::nullopt;
    }

  private:
    // Of the whole when sizes are fitted, and of what is left of that for each of the two files of an
    // error: some ten errors are tried.
    static constexpr double kFitted = 0.97, kShareOfAFile = 0.12;

    const BakeReader& bake_;
    const BakeReader& gloss_bake_;
    const GlossyTarget& target_;
    const fs::path scratch_;
    SearchProgress& progress_;
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
    SearchProgress progress([&](const std::string& step, double done) {
        if (on_step) on_step("both", step, done);
    });
    progress.begin("reading", 0.2);
    JoinedFiles files(bake, gloss, options, target, scratch, progress);
    progress.advance(1.0);
    const double least_error = std::min(kLargestError, 1.02 * std::max(1e-4, files.least_error()));
    if (!find_smallest_error(files, least_error, kLargestError, most_bytes)) {
        const std::optional<uint64_t> bytes = files.make(kLargestError);
        throw_infeasible(fmt::format(
            "{}: --max-size asks for {} bytes; with errors of {:.0f} % of transfer and gloss {}",
            bake.directory().string(), most_bytes, 100.0 * kLargestError,
            bytes ? fmt::format("it takes {}", *bytes) : "there is no file"));
    }
    progress.begin("writing", 1.0);
    copy_whole_file(files.best_path(), output);
    progress.advance(1.0);
    return files.best();
}

}  // namespace

JoinedFile join_transfer_files(const BakeReader& bake, const TransferFiles& files,
                               const BandPower& power, const fs::path& output) {
    Asset whole = read_paim(files.diffuse);
    ReadOptions glossy;
    glossy.kind = TransferKind::glossy;
    Asset gloss = read_paim(files.gloss, glossy);
    const BakeReader gloss_bake = bake.gloss();
    set_frame_turns(gloss_bake, gloss);
    const auto rows_in_whole = [&](size_t part) {
        const std::vector<uint32_t> of_rows = vertices_of_rows(whole, part, bake);
        std::vector<uint32_t> vertices = match_part(gloss, part, gloss_bake);
        for (uint32_t& vertex : vertices) vertex = of_rows[vertex];
        return vertices;
    };
    forget_positions(files.gloss, gloss);
    JoinedFile joined;
    joined.frames = measure_frames(whole, bake, gloss_bake, power);
    auto provenance = nlohmann::ordered_json::parse(gloss.provenance_json);
    provenance["frames"] = {{"relative_rms", joined.frames.relative_rms},
                            {"worst_row", joined.frames.worst_row}};
    for (const GlossMaterial& material : bake.identity().gloss->materials) {
        provenance["brdfs"].push_back(material.brdf);
    }
    gloss.provenance_json = json_text(provenance);
    const std::vector<uint32_t> vertices = rows_in_whole(0);
    const std::vector<uint32_t> still =
        gloss.still() != nullptr ? rows_in_whole(1) : std::vector<uint32_t>();
    join_gloss(std::move(gloss), vertices, still, whole);
    write_paim(output, whole);
    joined.size_bytes = fs::file_size(output);
    return joined;
}

double GlossySummary::gloss_error() const {
    return std::hypot(gloss.error.transfer.total(), both.frames.relative_rms);
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
    GlossyTarget errors = target;
    errors.gloss.size_bytes.reset();
    const auto with = [&](const BakeReader& reader, const char* part) {
        return [&options, &reader, heard = listener(part)](const EncodeTarget& of,
                                                           const fs::path& path) {
            return encode_to_target(reader, options, of, path, heard);
        };
    };
    GlossySummary summary = encode_both(bake, gloss, errors, with(bake, "diffuse"),
                                        with(gloss, "gloss"), scratch, scratch / "made.paim");
    const uint64_t size_bytes = summary.both.size_bytes;
    if (target.diffuse.size_bytes && size_bytes > *target.diffuse.size_bytes) {
        throw_infeasible(fmt::format(
            "{}: a transfer error of {:.3g} % and a gloss error of {:.3g} % take {} "
            "bytes, --max-size allows {}",
            bake.directory().string(), 100.0 * *target.diffuse.transfer_error,
            100.0 * *target.gloss.transfer_error, size_bytes, *target.diffuse.size_bytes));
    }
    copy_whole_file(scratch / "made.paim", output);
    return summary;
}

}  // namespace paim
