// Which files a sweep makes.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "analysis/trade/trade_point.h"

namespace paim {

// --max-error of the points, from the largest, each about 0.6 of the one before. Those that the
// bake cannot reach are left out.
const std::vector<std::string>& usual_errors();

// Fewer bands leave out what is seen of almost any light.
constexpr uint32_t kFewestUsualBands = 3;

// All of kFewestUsualBands to those of the bake, descending.
std::vector<uint32_t> usual_bands(uint32_t baked);

// Positions are coded to the default --geometry-error, and to one that is so many times smaller: errors of
// positions are seen at outlines, and often more than those of the transfer.
constexpr double kFinerGeometry = 4.0;

// Points of so many bands and this error: both errors of the geometry, each codec, each preference.
std::vector<TradeSettings> points_of(uint32_t bands, const std::string& max_error);

// Such an error as it is written: four digits, in percent. Above 0, below 1.
std::string max_error_text(double error);

// As the encoder reads it. Error (usage): not above 0 and below 1.
double max_error_of(const std::string& text);

}  // namespace paim
