// Which files a sweep makes.
#include "analysis/trade/grid.h"

#include <fmt/format.h>

#include <limits>

#include "compressor/encode/search/transfer_encoder.h"
#include "paim/cli/parse.h"
#include "paim/codec/codecs.h"

namespace paim {

const std::vector<std::string>& usual_errors() {
    static const std::vector<std::string> errors{"20%",  "12%",  "8%",   "5%",   "3%",   "2%",
                                                 "1.2%", "0.8%", "0.5%", "0.3%", "0.2%", "0.1%"};
    return errors;
}

std::vector<uint32_t> usual_bands(uint32_t baked) {
    std::vector<uint32_t> bands{baked};
    while (bands.back() > kFewestUsualBands) bands.push_back(bands.back() - 1);
    return bands;
}

std::vector<TradeSettings> points_of(uint32_t bands, const std::string& max_error) {
    const std::string finer =
        max_error_text(max_error_of(max_error) * kGeometryPerTransferError / kFinerGeometry);
    std::vector<TradeSettings> points;
    for (const std::string& geometry_error : {std::string(), finer}) {
        for (const TransferEncoderType& type : transfer_encoders()) {
            for (const Preference preference : {Preference::size, Preference::speed}) {
                points.push_back(
                    {bands, std::string(type.codec), preference, max_error, geometry_error});
            }
        }
    }
    return points;
}

std::vector<TradeSettings> plain_points_of(uint32_t bands, Precision precision,
                                           const SweepAxes& axes) {
    std::vector<TradeSettings> points;
    TradeSettings settings;
    settings.bands = bands;
    settings.codec = plain_codec().name;
    settings.precision = precision;
    points.push_back(settings);
    for (const std::string& error : axes.plain_errors) {
        settings.max_error = error;
        points.push_back(settings);
    }
    return points;
}

std::string usual_plain_error() {
    return max_error_text(EncodeOptions().automatic_transfer_error);
}

size_t num_points(const SweepAxes& axes) {
    size_t count = 0;
    for (const Precision precision : axes.precisions) {
        count += is_integer(precision) ? axes.errors.size() * points_of(1, "1%").size()
                                       : plain_points_of(1, precision, axes).size();
    }
    return count;
}

double max_error_of(const std::string& text) {
    return cli::parse_share(text, "--max-error");
}

double TradeSettings::transfer_error() const {
    return keeps_all_components() ? std::numeric_limits<double>::quiet_NaN()
                                  : max_error_of(max_error);
}

double TradeSettings::geometry_target() const {
    if (is_plain()) return std::numeric_limits<double>::quiet_NaN();
    return geometry_error.empty() ? kGeometryPerTransferError * transfer_error()
                                  : max_error_of(geometry_error);
}

std::string max_error_text(double error) {
    return fmt::format("{:.4g}%", 100.0 * error);
}

}  // namespace paim
