// Which files a sweep makes.
#include "analysis/trade/grid.h"

#include <fmt/format.h>

#include "compressor/encode/search/transfer_encoder.h"
#include "paim/cli/parse.h"

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

double max_error_of(const std::string& text) {
    return cli::parse_share(text, "--max-error");
}

double TradeSettings::transfer_error() const {
    return max_error_of(max_error);
}

double TradeSettings::geometry_target() const {
    return geometry_error.empty() ? kGeometryPerTransferError * transfer_error()
                                  : max_error_of(geometry_error);
}

std::string max_error_text(double error) {
    return fmt::format("{:.4g}%", 100.0 * error);
}

}  // namespace paim
