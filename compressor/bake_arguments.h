// The bake options of paim-compress.
#pragma once

#include <CLI/CLI.hpp>

#include <optional>
#include <string>
#include <vector>

#include "compressor/options.h"

namespace paim {

// Values whose form is checked after parsing.
struct BakeArguments {
    std::string albedo;
    std::vector<std::string> materials;
    std::string gloss_bands;
    bool floor = false;
    std::string floor_albedo;
    uint32_t floor_vertices = FloorOptions().num_vertices;
    std::optional<uint32_t> rays;
    std::string noise_target;
    std::string transfer_error;  // the former name of noise_target
};

// Adds the options that most bakes need, to the command with and without `bake`.
void add_everyday_bake_options(CLI::App& app, CompressOptions& options, BakeArguments& arguments);

// Adds the other options. Values go to `options`, or to `arguments` if apply() must check them.
void add_bake_options(CLI::App& app, CompressOptions& options, BakeArguments& arguments);

// Checks the arguments and sets the options. Error (usage) for values out of range.
void apply(const BakeArguments& arguments, CompressOptions& options);

}  // namespace paim
