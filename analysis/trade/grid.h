// Which files a sweep makes.
#pragma once

#include <array>
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

// Points of integers, of so many bands and this error: both errors of the geometry, each codec, each
// preference.
std::vector<TradeSettings> points_of(uint32_t bands, const std::string& max_error);

// What the points of a sweep are made of, whatever the number of bands.
struct SweepAxes {
    std::vector<std::string> errors;  // --max-error, from the largest
    // --auto-transfer-error of plain storage, besides all components: those that were asked for, else the
    // encoder's default.
    std::vector<std::string> plain_errors;
    std::vector<Precision> precisions;  // of kSweepPrecisions, each once
};

// Integers and both kinds of floats.
inline constexpr std::array kSweepPrecisions{Precision::i16, Precision::f16, Precision::f32};

// --auto-transfer-error where nothing was asked for.
std::string usual_plain_error();

// Points of plain storage of so many bands: all components, then those of each error.
std::vector<TradeSettings> plain_points_of(uint32_t bands, Precision precision,
                                           const SweepAxes& axes);

// How many points there are at one number of bands.
size_t num_points(const SweepAxes& axes);

// Such an error as it is written: four digits, in percent. Above 0, below 1.
std::string max_error_text(double error);

// As the encoder reads it. Error (usage): not above 0 and below 1.
double max_error_of(const std::string& text);

}  // namespace paim
