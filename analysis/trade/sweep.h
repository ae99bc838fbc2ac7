// Makes and measures the files of a trade.
#pragma once

#include <filesystem>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "analysis/trade/grid.h"
#include "analysis/trade/trade_point.h"
#include "compressor/encode/search/target_encode.h"

namespace paim {

// Every point is a real file: encode_command() writes the same bytes. What does not depend on the
// point is computed once for each number of bands (TargetSeries), so points of the same bands, and
// of these points of the same error, had better follow each other.
class Sweep {
  public:
    // Keeps a reference to the bake.
    // bake     verified (BakeReader::verify_all)
    // scratch  a path that files are written to, one after another, and removed from
    // name     of the files
    // memory_bytes  what the command line may take for one file, by default
    Sweep(const BakeReader& bake, std::string name, std::filesystem::path scratch, PlayFile play,
          uint64_t memory_bytes = EncodeOptions().memory_bytes);

    // Nothing if no file has these settings: a note says why.
    std::optional<TradePoint> measure(const TradeSettings& settings);

    // Adds those points that files of so many bands can have. The others are left out with a note.
    // on_points  called with a number of points that are done, or left out; num_points() in all
    void measure_all(uint32_t bands, const SweepAxes& axes, std::vector<TradePoint>& points,
                     const std::function<void(uint64_t)>& on_points);

    const std::vector<std::string>& notes() const { return notes_; }

  private:
    // The series of so many bands; that of other bands is gone by then.
    TargetSeries& series_of(uint32_t bands);
    // Whether there is memory for so many bands; else a note says what is needed.
    bool can_begin(uint32_t bands);
    double least_error(uint32_t bands);  // 0 if it is not known
    EncodeTarget target_of(const TradeSettings& settings) const;
    // Writes the file, and says what is known of it without reading it.
    TradePoint encode(TargetSeries& series, const TradeSettings& settings);
    TradePoint encode_plain(TargetSeries& series, const TradeSettings& settings);
    TradePoint encode_integers(TargetSeries& series, const TradeSettings& settings);
    // Costs and what only playing shows, of the file.
    void measure_file(TradePoint& point) const;
    void measure_integers(uint32_t bands, const std::vector<std::string>& max_errors,
                          std::vector<TradePoint>& points,
                          const std::function<void(uint64_t)>& on_points);

    const BakeReader& bake_;
    const std::string name_;
    const std::filesystem::path scratch_;
    const PlayFile play_;
    const uint64_t memory_bytes_;
    std::optional<TargetSeries> series_;
    uint32_t series_bands_ = 0;
    double series_s_ = 0.0;                    // that it took to begin
    std::map<std::string, double> prepare_s_;  // by error, what its components took at first
    std::vector<std::string> notes_;
};

}  // namespace paim
