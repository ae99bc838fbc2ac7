// The encode options of paim-compress.
#pragma once

#include <CLI/CLI.hpp>

#include <optional>
#include <string>

#include "compressor/options.h"

namespace paim {

enum class PrecisionChoice : uint32_t { automatic, f32, f16 };

// Values whose form is checked after parsing.
struct EncodeArguments {
    std::string max_error, max_size, max_vertex_error, max_gloss_error;
    std::string geometry_error, max_sted;
    std::optional<double> max_normal_angle;
    std::optional<uint32_t> max_decode_cost;
    std::string codec = "auto";
    Preference preference = Preference::size;
    std::string geometry_components = "auto";
    std::string transfer_components = "auto";
    std::string auto_transfer_error = "1%";
    PrecisionChoice precision = PrecisionChoice::automatic;
    std::string memory = "1G";

    bool has_target() const { return !max_error.empty() || !max_size.empty(); }
};

// Adds the options that most files need, to the command with and without `encode`.
void add_everyday_encode_options(CLI::App& app, CompressOptions& options,
                                 EncodeArguments& arguments);

// Adds the other options. Values go to `options`, or to `arguments` if apply() must check them.
void add_encode_options(CLI::App& app, CompressOptions& options, EncodeArguments& arguments);

// Checks the arguments and sets the options. Error (usage) for values out of range, for options
// that need a target without one, and for options that a target decides.
void apply(const EncodeArguments& arguments, CompressOptions& options);

}  // namespace paim
