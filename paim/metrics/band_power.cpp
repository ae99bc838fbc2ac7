// Band power of light, which weights errors of the transfer.
// Based on: Dror, Willsky and Adelson 2004 (see the header)
#include "paim/metrics/band_power.h"

#include <cmath>
#include <filesystem>
#include <utility>

#include "paim/base/check.h"
#include "paim/base/error.h"
#include "paim/light/load_light.h"

namespace paim {

namespace {

BandPower measured(const std::filesystem::path& path, EnvMapping mapping) {
    LoadedLight loaded = load_light(path, mapping);
    const LightCoefficients light = loaded.light.coefficients(static_cast<int>(sh::kMaxBands));
    BandPower spectrum{path.filename().string(), {}, 0.0, std::move(loaded.notes)};
    for (int l = 0; l < sh::kMaxBands; ++l) {
        double sum = 0.0;
        for (int m = -l; m <= l; ++m) {
            const auto i = static_cast<size_t>(sh::index(l, m));
            sum += light.values[i].cast<double>().squaredNorm();
        }
        spectrum.weights.push_back(sum / (3.0 * (2.0 * l + 1.0)));
    }
    const double first = spectrum.weights[0];
    if (!(first > 0.0)) throw_bad_input("{}: expected light, got a black map", path.string());
    for (double& weight : spectrum.weights) weight /= first;
    return spectrum;
}

}  // namespace

double BandPower::weight(uint32_t band) const {
    if (band < weights.size()) return weights[band];
    return decay > 0.0 ? std::pow(band + 1.0, -decay) : 0.0;
}

BandPower BandPower::flat(uint32_t bands) {
    return {"flat", std::vector<double>(bands, 1.0), 0.0};
}

BandPower BandPower::natural() {
    return {"natural", {}, 2.0};
}

BandPower parse_band_power(std::string_view text, uint32_t bands, EnvMapping mapping) {
    PAIM_CHECK(bands >= 1 && bands <= static_cast<uint32_t>(sh::kMaxBands));
    if (text == "flat") return BandPower::flat(bands);
    if (text == "natural") return BandPower::natural();
    const std::filesystem::path path(text);
    if (!path.has_extension()) {
        throw_usage("light spectrum: expected flat, natural or an OpenEXR file, got '{}'", text);
    }
    return measured(path, mapping);
}

}  // namespace paim
