// What command lines and messages about environment maps share.
#include "paim/cli/light_options.h"

#include <fmt/format.h>

#include <cstdio>

namespace paim::cli {

CLI::Option* add_env_mapping(CLI::App& app, EnvMapping& mapping) {
    return add_choice<EnvMapping>(
        app, "--env-mapping", mapping, env_mapping_names(),
        "How environment maps lie on the sphere. latlong: longitude and latitude, 2:1. cube: six "
        "faces above each other, +X, -X, +Y, -Y, +Z, -Z, 1:6, as in OpenEXR. angular: a square "
        "light probe, in which the angle from -Z grows with the distance from the centre. auto: "
        "what the file's attribute envmap says, otherwise by its size");
}

void print_notes(const std::string& tool, const std::filesystem::path& file,
                 const std::vector<std::string>& notes) {
    for (const std::string& note : notes) {
        fmt::print(stderr, "{}: note: {}: {}\n", tool, file.string(), note);
    }
}

}  // namespace paim::cli
