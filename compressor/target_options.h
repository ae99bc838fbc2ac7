// The options of paim-compress that say what a file shall meet.
#pragma once

#include <CLI/CLI.hpp>

#include <filesystem>
#include <optional>
#include <string>

#include "compressor/encode/options.h"

namespace paim {

// As text, where the form needs checking after parsing.
struct RawTarget {
    std::string max_error, geometry_error, max_size;
    std::optional<uint32_t> max_decode_cost;
    std::string codec = "auto";
    std::string prefer = "size";
    std::string band_power = "flat";

    bool asked() const { return !max_error.empty() || !max_size.empty(); }
};

void add_target_options(CLI::App& app, RawTarget& raw);

// Everything but the spectrum, which needs the bake. Throws Error(usage) for values out of range and for
// options that mean something with a target only.
std::optional<EncodeTarget> parse_target(const RawTarget& raw);

}  // namespace paim
