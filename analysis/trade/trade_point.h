// One file that the command line of the encoder can make of a bake: what it costs, and what it errs.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <functional>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "compressor/encode/options.h"
#include "paim/codec/asset.h"
#include "paim/metrics/asset_error.h"

namespace paim {

// What is set on the command line; everything else has its default.
struct TradeSettings {
    uint32_t bands = 0;
    std::string codec;
    Preference preference = Preference::size;
    // --max-error as it is written: "3.5%". What is parsed from it is exactly what the file is made
    // for.
    std::string max_error;
    // --geometry-error as it is written: "0.03%"; empty: its default, kGeometryPerTransferError of the
    // above.
    std::string geometry_error = "";
    // Of another bake of the same poses, which has so many rays a vertex; 0: of the given bake.
    uint32_t rays = 0;
    // How values are stored. i16: integers, with the steps that meet the errors above. f16, f32: floats
    // without a target, the plain storage of Cardoso and Kry. Its codec is plain_transfer()'s, nothing is
    // preferred, and there is no error of the geometry.
    Precision precision = Precision::i16;

    bool is_plain() const { return !is_integer(precision); }
    // Of plain storage, whose max_error is then empty. Otherwise max_error is where components of the
    // transfer are cut: --auto-transfer-error as it is written.
    bool keeps_all_components() const { return is_plain() && max_error.empty(); }
    double transfer_error() const;   // 0 … 1; not a number if all components are kept
    double geometry_target() const;  // RMS distance by the diagonal; not a number for plain storage
    bool operator==(const TradeSettings&) const = default;
};

// What only playing a file shows. Not a number: not measured.
struct PlayedFile {
    double visual_error = std::numeric_limits<double>::quiet_NaN();  // fraction
    double frame_ms =
        std::numeric_limits<double>::quiet_NaN();  // to decode and light a frame on the CPU
};
// Empty: nothing is measured.
using PlayFile = std::function<PlayedFile(const Asset&)>;

struct TradePoint {
    TradeSettings settings;
    bool refined = false;   // between points of the grid
    bool on_front = false;  // no other point is as good in everything and better in something

    uint32_t geometry_components = 0, transfer_components = 0;
    std::vector<CodecNumber> numbers;  // what else the codec chose
    uint64_t size_bytes = 0;
    double bits_per_vertex_per_pose = 0.0;
    // A frame takes these of the transfer, lit, and of the positions, for each vertex, and these on
    // the CPU once for all vertices (FrameCost).
    uint64_t multiply_adds = 0, position_multiply_adds = 0, cpu_multiply_adds = 0;
    AssetError error;
    double visual_error = std::numeric_limits<double>::quiet_NaN();  // fraction

    // Of this machine. A point of its own would take encode_s and shared_s.
    double encode_s = 0.0;  // what no point before had computed
    double shared_s = 0.0;  // components of its bands and of its error, which other points have too
    double frame_ms = std::numeric_limits<double>::quiet_NaN();
    double bake_s = std::numeric_limits<double>::quiet_NaN();  // of the bake; not of the given one

    // The larger one of the moving and the still part: a target holds for each by itself.
    double transfer_error() const {
        const double still = error.still ? error.still->transfer.total() : 0.0;
        return std::max(error.transfer.total(), still);
    }
};

// Which error a trade is about.
enum class TradeError : uint32_t { transfer, visual };

// Visual errors where any was measured.
inline TradeError error_kind(const std::vector<TradePoint>& points) {
    const auto is_seen = [](const TradePoint& point) { return std::isfinite(point.visual_error); };
    return std::any_of(points.begin(), points.end(), is_seen) ? TradeError::visual
                                                              : TradeError::transfer;
}

inline double error_of(const TradePoint& point, TradeError kind) {
    return kind == TradeError::visual ? point.visual_error : point.transfer_error();
}

// "visual error", for texts.
inline const char* error_name(TradeError kind) {
    return kind == TradeError::visual ? "visual error" : "transfer error";
}

// As --prefer has it.
inline const char* preference_name(Preference preference) {
    return preference == Preference::speed ? "speed" : "size";
}

// As --sweep-precision has it.
inline const char* sweep_precision_name(Precision precision) {
    return is_integer(precision) ? "integers" : precision_name(precision);
}

}  // namespace paim
