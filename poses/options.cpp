// Options of paim-poses, each described once.
#include "poses/options.h"

#include <fmt/format.h>

#include "paim/base/error.h"
#include "paim/cli/parse.h"
#include "poses/catalog.h"

namespace paim::poses {

namespace {

constexpr int64_t kMaxPoses = 10'000;

// Options are read as wider integers, so that numbers out of range give our message.
uint32_t checked(const char* option, int64_t value, int64_t low, int64_t high) {
    if (value < low || value > high) {
        throw_usage("{}: expected {} to {}, got {}", option, low, high, value);
    }
    return static_cast<uint32_t>(value);
}

std::string names() {
    std::string text = "What to make:\n";
    for (const CatalogEntry& entry : catalog()) {
        text += fmt::format("  {:8} {} ({} to {} vertices)\n", entry.name, entry.description,
                            entry.min_vertices, entry.max_vertices);
    }
    return text;
}

}  // namespace

int parse_options(int argc, const char* const* argv, Options& options) {
    CLI::App app(
        "Writes a procedural pose sequence as OBJ files, DIR/NAME_0000.obj and on; Y is up, the "
        "sequence loops.");
    app.footer(names());
    int64_t num_poses = options.num_poses, num_vertices = options.num_vertices;
    bool plain = false;
    app.add_option("NAME", options.name, "Sequence to make, see below")->required();
    app.add_option("-o,--output", options.directory, "Directory for the files; made if missing")
        ->required();
    app.add_option("--poses", num_poses, fmt::format("Number of poses, 1 to {}", kMaxPoses))
        ->capture_default_str();
    app.add_option(
           "--vertices", num_vertices,
           "Number of vertices: exact for the octopus, else the nearest that the shape can have")
        ->capture_default_str();
    app.add_flag("--plain", plain, "Leave out the octopus' colours (v x y z r g b, linear)");
    app.add_option("--threads", options.num_threads, "Threads, 0 for every core")
        ->capture_default_str();
    app.add_flag("--json", options.json, "Print one JSON object on stdout, and nothing else");
    app.set_version_flag("--version", cli::version_text("paim-poses"));
    if (const int code = cli::parse(app, argc, argv); code >= 0) return code;

    const CatalogEntry& entry = find_sequence(options.name);
    options.num_poses = checked("--poses", num_poses, 1, kMaxPoses);
    options.num_vertices = checked(fmt::format("--vertices of {}", entry.name).c_str(),
                                   num_vertices, entry.min_vertices, entry.max_vertices);
    options.num_threads = static_cast<int>(checked("--threads", options.num_threads, 0, 1024));
    options.colored = !plain;
    return -1;
}

}  // namespace paim::poses
