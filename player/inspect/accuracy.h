// How exact the animation is within limits, over the whole sequence: what the file states of itself,
// and what the limits add.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "paim/codec/asset.h"
#include "paim/codec/decode_limits.h"
#include "paim/metrics/asset_error.h"
#include "player/inspect/cost.h"

namespace paim::player {

// What is left out of one matrix.
struct Truncation {
    uint32_t used = 0, in_file = 0;  // components
    // Of the components in use, from the singular values that the file has: E5, and the energy error
    // (paim/metrics/singular_value_error.h). They include the components that are not in the file.
    // Nothing if the file lacks singular values.
    std::optional<double> theory_error, energy_error;
};

// Of the first part, the animation. Errors are fractions: those of the transfer of the norm of the
// bake's transfer, weighted by the band power; those of positions of the diagonal.
struct Accuracy {
    Truncation geometry, transfer;
    uint32_t bands = 0, bands_in_file = 0;
    std::optional<uint32_t> bands_in_bake;  // where the file says so

    // What the limits leave out of the values of the file, from the values themselves. E5 cannot be
    // added to errors that are norms, but these can. Components of vertices are not in them.
    double transfer_dropped = 0.0;  // components and bands
    double bands_dropped = 0.0;     // of it the bands alone
    double position_dropped = 0.0;  // RMS, without exceptions (LowRank::num_usual_components())

    // √(stated² + dropped²), if what the limits drop is orthogonal to the error of the whole file.
    // Nothing where the file states no such error, where it has not been read to its end, or where
    // components of vertices are left out, whose share is not known.
    std::optional<double> transfer_total, position_total;

    Cost cost{};
};

// Adds up the values of the file once, which takes as long as decoding one pose for each component;
// at() is quick.
class AccuracyMeter {
  public:
    // asset  with at least one part
    explicit AccuracyMeter(std::shared_ptr<const Asset> asset);

    Accuracy at(const DecodeLimits& limits) const;

    // Of the whole file; nothing if it states none, or if the statement cannot be read.
    const std::optional<ErrorStatement>& stated() const { return stated_; }
    // Why there is no statement: a sentence, or empty.
    const std::string& note() const { return note_; }
    // By which errors of the transfer are weighted: `flat` or `natural` (docs/metrics.md). A statement
    // under a map is not added to anything.
    const std::string& band_power() const { return band_power_; }

  private:
    void read_statement();
    void add_up_transfer();
    void add_up_positions();

    std::shared_ptr<const Asset> asset_;
    std::optional<ErrorStatement> stated_;
    std::string note_, band_power_;
    std::optional<uint32_t> bands_in_bake_;
    std::optional<double> whole_transfer_, whole_position_;  // stated errors that can be added to
    // [bands] Squares, as fractions of the norm of the bake's transfer.
    std::vector<double> band_share_;                  // of all that the file has
    std::vector<std::vector<double>> dropped_share_;  // [bands][1 + Kt] of what k components lack
    std::vector<double> dropped_positions_;           // [1 + Kg] RMS, fractions of the diagonal
};

}  // namespace paim::player
