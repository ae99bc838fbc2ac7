// Makes and measures the files of a trade.
#include "analysis/trade/sweep.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <chrono>
#include <utility>

#include "analysis/trade/grid.h"
#include "paim/base/error.h"
#include "paim/base/file.h"
#include "paim/codec/frame_cost.h"
#include "paim/format/paim/paim_read.h"
#include "paim/metrics/rates.h"

namespace paim {

namespace {

struct SweptFileRemover {
    const std::filesystem::path& path;
    ~SweptFileRemover() {
        std::error_code ignored;
        std::filesystem::remove(path, ignored);
    }
};

// Seconds that `work` takes.
template <typename Work>
double seconds_of(const Work& work) {
    using Clock = std::chrono::steady_clock;
    const auto start = Clock::now();
    work();
    return std::chrono::duration<double>(Clock::now() - start).count();
}

// What the command line sets, with its defaults.
EncodeOptions options_of(const std::string& name, uint32_t bands, uint64_t memory_bytes) {
    EncodeOptions options;
    options.bands = bands;
    options.precision = Precision::i16;
    options.memory_bytes = memory_bytes;
    options.name = name;
    return options;
}

// Whether an error says that there is no such file, and others may be.
bool is_of_settings(const Error& error) {
    return error.code() == ExitCode::threshold_exceeded || error.code() == ExitCode::unsupported;
}

std::string bands_text(uint32_t bands) {
    return fmt::format("{} band{}", bands, bands == 1 ? "" : "s");
}

}  // namespace

Sweep::Sweep(const BakeReader& bake, std::string name, std::filesystem::path scratch, PlayFile play,
             uint64_t memory_bytes)
    : bake_(bake),
      name_(std::move(name)),
      scratch_(std::move(scratch)),
      play_(std::move(play)),
      memory_bytes_(memory_bytes) {
    remove_abandoned_versions(scratch_);
}

TargetSeries& Sweep::series_of(uint32_t bands) {
    if (series_ && series_bands_ == bands) return *series_;
    series_.reset();  // first, so that there is memory
    prepare_s_.clear();
    series_s_ = seconds_of([&] {
        series_.emplace(bake_, options_of(name_, bands, memory_bytes_),
                        BandPower::flat(bake_.identity().layout.in_bands));
    });
    series_bands_ = bands;
    return *series_;
}

EncodeTarget Sweep::target_of(const TradeSettings& settings) const {
    EncodeTarget target;
    target.transfer_error = settings.transfer_error();
    if (!settings.geometry_error.empty()) {
        target.geometry_error = max_error_of(settings.geometry_error);
    }
    target.codec = settings.codec;
    target.preference = settings.preference;
    target.spectrum = BandPower::flat(bake_.identity().layout.in_bands);
    return target;
}

TradePoint Sweep::point_of(const TradeSettings& settings, const TargetSummary& summary) {
    const Candidate& chosen = summary.chosen();
    TradePoint point;
    point.settings = settings;
    point.geometry_components = summary.geometry_components;
    point.transfer_components = chosen.components;
    point.numbers = chosen.numbers;
    point.size_bytes = summary.size_bytes;
    point.bits_per_vertex_per_pose =
        bits_per_vertex_per_pose(summary.size_bytes, summary.num_vertices, summary.num_poses);
    point.error = summary.error;
    const Asset asset = read_paim(scratch_);
    const CodedMesh& mesh = asset.moving();
    const FrameCost cost = mesh.transfer->cost(mesh.layout, {}, true);
    point.multiply_adds = cost.per_vertex();
    point.cpu_multiply_adds = cost.cpu_per_frame;
    point.position_multiply_adds = positions_cost(summary.geometry_components).per_vertex();
    if (play_) {
        const PlayedFile played = play_(asset);
        point.visual_error = played.visual_error;
        point.frame_ms = played.frame_ms;
    }
    return point;
}

std::optional<TradePoint> Sweep::measure(const TradeSettings& settings) {
    const SweptFileRemover remover{scratch_};
    try {
        TargetSeries& series = series_of(settings.bands);
        const EncodeTarget target = target_of(settings);
        const double prepare_s = seconds_of([&] { series.prepare(target); });
        const std::string key = settings.max_error + "/" + settings.geometry_error;
        prepare_s_.try_emplace(key, prepare_s);
        TargetSummary summary;
        const double encode_s = seconds_of([&] { summary = series.encode(target, scratch_); });
        TradePoint point = point_of(settings, summary);
        point.encode_s = encode_s;
        point.shared_s = series_s_ + prepare_s_.at(key);
        return point;
    } catch (const Error& error) {
        if (!is_of_settings(error)) throw;
        notes_.push_back(fmt::format(
            "{}, --max-error {}{}, --codec {}, --prefer {} is left out: {}",
            bands_text(settings.bands), settings.max_error,
            settings.geometry_error.empty() ? "" : " --geometry-error " + settings.geometry_error,
            settings.codec, preference_name(settings.preference), error.what()));
        return std::nullopt;
    }
}

bool Sweep::can_begin(uint32_t bands) {
    try {
        series_of(bands);
        return true;
    } catch (const Error& error) {
        if (!is_of_settings(error)) throw;
        notes_.push_back(fmt::format("{} are left out: {}", bands_text(bands), error.what()));
        return false;
    }
}

double Sweep::least_error(uint32_t bands) {
    try {
        return series_of(bands).least_error();
    } catch (const Error& error) {
        if (!is_of_settings(error)) throw;
        return 0.0;  // each point says what is wrong
    }
}

void Sweep::measure_all(uint32_t bands, const std::vector<std::string>& max_errors,
                        std::vector<TradePoint>& points,
                        const std::function<void(uint64_t)>& on_points) {
    if (!can_begin(bands)) {
        for (const std::string& max_error : max_errors) {
            on_points(points_of(bands, max_error).size());
        }
        return;
    }
    const double least = least_error(bands);
    std::vector<std::string> too_small;
    for (const std::string& max_error : max_errors) {
        const std::vector<TradeSettings> wanted = points_of(bands, max_error);
        if (wanted.front().transfer_error() <= least) {
            too_small.push_back(max_error);
            on_points(wanted.size());
            continue;
        }
        for (const TradeSettings& settings : wanted) {
            if (auto point = measure(settings)) points.push_back(std::move(*point));
            on_points(1);
        }
    }
    if (too_small.empty()) return;
    notes_.push_back(fmt::format("{} have {:.3g} % at best: {} {} left out", bands_text(bands),
                                 100.0 * least, fmt::join(too_small, ", "),
                                 too_small.size() == 1 ? "is" : "are"));
}

}  // namespace paim
