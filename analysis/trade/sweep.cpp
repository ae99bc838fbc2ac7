// Makes and measures the files of a trade.
#include "analysis/trade/sweep.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <utility>

#include "analysis/seconds_of.h"
#include "analysis/trade/encode_command.h"
#include "compressor/encode/encode.h"
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

TradePoint Sweep::encode_integers(TargetSeries& series, const TradeSettings& settings) {
    const EncodeTarget target = target_of(settings);
    const double prepare_s = seconds_of([&] { series.prepare(target); });
    const std::string key = settings.max_error + "/" + settings.geometry_error;
    prepare_s_.try_emplace(key, prepare_s);
    TargetSummary summary;
    TradePoint point;
    point.encode_s = seconds_of([&] { summary = series.encode(target, scratch_); });
    point.shared_s = series_s_ + prepare_s_.at(key);
    point.geometry_components = summary.geometry_components;
    point.transfer_components = summary.chosen().components;
    point.numbers = summary.chosen().numbers;
    point.error = summary.error;
    return point;
}

TradePoint Sweep::encode_plain(TargetSeries& series, const TradeSettings& settings) {
    EncodeOptions options = options_of(name_, settings.bands, memory_bytes_);
    options.precision = settings.precision;
    options.measure = true;
    if (settings.keeps_all_components()) {
        options.geometry.kind = options.transfer.kind = ComponentChoice::Kind::all;
    } else {
        options.automatic_transfer_error = settings.transfer_error();
    }
    EncodeSummary summary;
    TradePoint point;
    point.encode_s = seconds_of(
        [&] { summary = paim::encode(bake_, options, series.decomposition(), scratch_); });
    point.shared_s = series_s_;
    point.geometry_components = summary.geometry_components;
    point.transfer_components = summary.transfer_components;
    point.error = *summary.measured;
    return point;
}

TradePoint Sweep::encode(TargetSeries& series, const TradeSettings& settings) {
    return settings.is_plain() ? encode_plain(series, settings) : encode_integers(series, settings);
}

void Sweep::measure_file(TradePoint& point) const {
    const Asset asset = read_paim(scratch_);
    const CodedMesh& mesh = asset.moving();
    point.size_bytes = std::filesystem::file_size(scratch_);
    point.bits_per_vertex_per_pose =
        bits_per_vertex_per_pose(point.size_bytes, mesh.topology.num_vertices, mesh.num_poses());
    const FrameCost cost = mesh.transfer->cost(mesh.layout, {}, true);
    point.multiply_adds = cost.per_vertex();
    point.cpu_multiply_adds = cost.cpu_per_frame;
    point.position_multiply_adds = positions_cost(point.geometry_components).per_vertex();
    if (play_) {
        const PlayedFile played = play_(asset);
        point.visual_error = played.visual_error;
        point.frame_ms = played.frame_ms;
    }
}

std::optional<TradePoint> Sweep::measure(const TradeSettings& settings) {
    const SweptFileRemover remover{scratch_};
    try {
        TradePoint point = encode(series_of(settings.bands), settings);
        point.settings = settings;
        measure_file(point);
        return point;
    } catch (const Error& error) {
        if (!is_of_settings(error)) throw;
        notes_.push_back(
            fmt::format("{} is left out: {}", encode_arguments(settings), error.what()));
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

void Sweep::measure_all(uint32_t bands, const SweepAxes& axes, std::vector<TradePoint>& points,
                        const std::function<void(uint64_t)>& on_points) {
    if (!can_begin(bands)) {
        on_points(num_points(axes));
        return;
    }
    for (const Precision precision : axes.precisions) {
        if (is_integer(precision)) {
            measure_integers(bands, axes.errors, points, on_points);
            continue;
        }
        for (const TradeSettings& settings : plain_points_of(bands, precision, axes)) {
            if (auto point = measure(settings)) points.push_back(std::move(*point));
            on_points(1);
        }
    }
}

void Sweep::measure_integers(uint32_t bands, const std::vector<std::string>& max_errors,
                             std::vector<TradePoint>& points,
                             const std::function<void(uint64_t)>& on_points) {
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
