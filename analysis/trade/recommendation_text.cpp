// What to run for a wanted limit, in words.
#include <fmt/format.h>

#include <cmath>

#include "analysis/trade/encode_command.h"
#include "analysis/trade/trade.h"

namespace paim {

namespace {

// A file of the recommendation, and what it is.
std::string point_text(const std::filesystem::path& bake, const TradePoint& point,
                       const std::string& what) {
    const std::string seen =
        std::isnan(point.visual_error)
            ? std::string()
            : fmt::format("visual error {:.3g} %, ", 100.0 * point.visual_error);
    const AssetError& error = point.error;
    return fmt::format(
        "{}:\n  {}\n  {} bytes, {:.3g} bits per vertex and pose, {} multiply-adds a vertex and frame; "
        "{}transfer error {:.3g} %; RMS distance {:.3g} ({:.2g} % of the diagonal), STED {:.3g} %, "
        "face normals {:.3g} degrees\n",
        what, encode_command(bake, point.settings), point.size_bytes,
        point.bits_per_vertex_per_pose, point.multiply_adds, seen, 100.0 * point.transfer_error(),
        error.geometry.rms(), 100.0 * error.geometry.relative_rms(),
        100.0 * error.shape.worst.sted(), error.shape.worst.normal_angle_deg);
}

}  // namespace

std::string recommendation_text(const std::filesystem::path& bake, const Trade& trade) {
    if (!trade.best) return {};
    const std::string limit = limit_text(*trade.limit, trade.kind);
    const std::string best = trade.limit->of == TradeLimit::Of::error
                                 ? "the smallest file"
                                 : fmt::format("the smallest {}", error_name(trade.kind));
    std::string text =
        point_text(bake, trade.points[*trade.best], fmt::format("{} with {}", best, limit));
    if (trade.cheapest && trade.cheapest != trade.best) {
        text += point_text(bake, trade.points[*trade.cheapest],
                           fmt::format("the cheapest to play with {}", limit));
    }
    return text;
}

}  // namespace paim
