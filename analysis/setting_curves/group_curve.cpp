// Error curve over the number of groups of vertices that share values.
#include "analysis/setting_curves/group_curve.h"

#include <fmt/format.h>

#include <algorithm>
#include <memory>
#include <utility>

#include "analysis/bake_file.h"
#include "analysis/file_poses.h"
#include "analysis/frame_time.h"
#include "analysis/scratch_directory.h"
#include "analysis/seconds_of.h"
#include "analysis/setting_curves/measure_settings.h"
#include "compressor/encode/search/target_encode.h"
#include "paim/base/check.h"
#include "paim/codec/frame_cost.h"
#include "paim/codec/point_groups.h"

namespace paim {

namespace {

struct GroupedFile {
    std::shared_ptr<const Asset> asset;
    uint32_t num_groups = 0;
    uint64_t size_bytes = 0;
    double encode_s = 0.0;
};

// Files of one bake, one after another.
class GroupedFiles {
  public:
    GroupedFiles(const BakeReader& bake, const std::filesystem::path& directory)
        : bake_(bake),
          path_(directory / "groups.paim"),
          spectrum_(BandPower::flat(bake.identity().layout.in_bands)),
          series_(bake, options_of(bake), spectrum_) {}

    GroupedFile make(uint32_t num_groups) {
        EncodeTarget target;
        target.geometry_error = kInvisibleMotion;
        target.codec = grouped_encoder().codec;
        target.spectrum = spectrum_;
        GroupedFile file;
        file.encode_s = seconds_of(
            [&] { series_.encode_groups(target, grouped_encoder(), num_groups, path_); });
        file.size_bytes = std::filesystem::file_size(path_);
        file.asset = std::make_shared<const Asset>(read_file_of(bake_, path_));
        file.num_groups = file.asset->moving().transfer->point_groups()->num_groups;
        return file;
    }

  private:
    static EncodeOptions options_of(const BakeReader& bake) {
        EncodeOptions options;
        options.precision = Precision::i16;
        options.name = bake.directory().stem().string();
        return options;
    }

    const BakeReader& bake_;
    const std::filesystem::path path_;
    const BandPower spectrum_;
    TargetSeries series_;
};

void add_columns(const GroupedFile& file, const Stage& stage, Setting& setting) {
    const CodedMesh& mesh = file.asset->moving();
    const FrameCost cost = mesh.transfer->cost(mesh.layout, {}, true);
    setting.columns = {
        {"vertex_components", "", mesh.transfer->num_vertex_components()},
        {"transfer_components", "", mesh.transfer->matrix.num_components},
        {"size", "bytes", file.size_bytes},
        {"multiply_adds", "per vertex and frame", cost.per_vertex()},
        {"cpu_multiply_adds", "per frame", cost.cpu_per_frame},
        {"encode", "s", file.encode_s},
        {"frame", "ms",
         time_frames(file.asset, stage.lights().front().coefficients, kQuickSeconds).median_ms}};
}

// Of each number once, descending.
std::vector<GroupedFile> make_files(const BakeReader& bake, std::vector<uint32_t> wanted,
                                    const std::filesystem::path& scratch,
                                    std::vector<std::string>& notes,
                                    const std::function<void()>& on_step) {
    std::sort(wanted.rbegin(), wanted.rend());
    wanted.erase(std::unique(wanted.begin(), wanted.end()), wanted.end());
    const ScratchDirectory directory(scratch, "groups");
    GroupedFiles maker(bake, directory.path());
    std::vector<GroupedFile> files;
    for (const uint32_t number : wanted) {
        GroupedFile file = maker.make(number);
        on_step();
        if (file.num_groups < number) {
            notes.push_back(fmt::format("{} {} asked for, there are vertices for {}", number,
                                        grouped_encoder().words.numbers.front(), file.num_groups));
        }
        if (files.empty() || file.num_groups < files.back().num_groups) {
            files.push_back(std::move(file));
        }
    }
    return files;
}

}  // namespace

const TransferEncoderType& grouped_encoder() {
    const std::vector<TransferEncoderType>& all = transfer_encoders();
    const auto found = std::find_if(all.begin(), all.end(), [](const TransferEncoderType& type) {
        return type.code_groups != nullptr;
    });
    PAIM_CHECK(found != all.end());
    return *found;
}

SettingCurve measure_groups(const BakeReader& bake, const Stage& stage, const Reference& reference,
                            const std::vector<uint32_t>& wanted,
                            const std::filesystem::path& scratch, std::vector<std::string>& notes,
                            const std::function<void()>& on_step) {
    const std::vector<GroupedFile> files = make_files(bake, wanted, scratch, notes, on_step);
    SettingCurve curve;
    curve.name = grouped_encoder().words.numbers.front();
    curve.axis = curve.name;
    curve.title = fmt::format("Number of {} of codec {}", curve.name, grouped_encoder().codec);
    curve.explanation = fmt::format(
        "Each is a file of this bake with {} components of a vertex and steps that add at most a "
        "hundredth to the error. Positions are those of the bake, so that pictures show what the transfer "
        "loses.",
        files.front().asset->moving().transfer->num_vertex_components());
    curve.logarithmic = true;
    curve.drawn = {"transfer_error"};
    curve.reference_name = reference.name;
    std::vector<std::unique_ptr<FilePoses>> poses;
    std::vector<SettingSource> sources;
    for (const GroupedFile& file : files) {
        Setting& setting = curve.settings.emplace_back();
        setting.value = file.num_groups;
        add_columns(file, stage, setting);
        FilePoses* const of_file =
            poses.emplace_back(std::make_unique<FilePoses>(*file.asset, bake)).get();
        sources.push_back({[of_file](uint32_t p) { return of_file->pose(p); }, of_file->still()});
    }
    measure_settings(curve, sources, stage, compared_with_bake(bake, reference), on_step);
    return curve;
}

}  // namespace paim
