// What command lines and messages about environment maps share.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "paim/cli/parse.h"
#include "paim/light/env_mapping.h"

namespace paim::cli {

// Adds --env-mapping.
CLI::Option* add_env_mapping(CLI::App& app, EnvMapping& mapping);

// "TOOL: note: FILE: …" on stderr, a line for each.
void print_notes(const std::string& tool, const std::filesystem::path& file,
                 const std::vector<std::string>& notes);

}  // namespace paim::cli
