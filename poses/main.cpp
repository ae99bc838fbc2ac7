// paim-poses: writes procedural pose sequences as OBJ.
#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "paim/base/json_text.h"
#include "paim/base/tbb_parallel.h"
#include "paim/cli/progress.h"
#include "paim/cli/run_main.h"
#include "poses/catalog.h"
#include "poses/obj_writer.h"
#include "poses/options.h"

namespace {

using namespace paim;

void report(const poses::Options& options, const Topology& topology, bool colored) {
    if (options.json) {
        const nlohmann::ordered_json result{
            {"name", options.name},
            {"directory", options.directory},
            {"num_poses", options.num_poses},
            {"num_vertices", topology.num_vertices},
            {"num_triangles", topology.triangles.size()},
            {"colored", colored},
            {"first_file", poses::obj_file_name(options.name, 0, options.num_poses)},
            {"last_file",
             poses::obj_file_name(options.name, options.num_poses - 1, options.num_poses)}};
        fmt::print("{}\n", json_text(result));
        return;
    }
    fmt::print("{}: {} vertices, {} triangles, {} poses in {}\n", options.name,
               topology.num_vertices, topology.triangles.size(), options.num_poses,
               options.directory);
}

int run(int argc, const char* const* argv) {
    poses::Options options;
    if (const int code = poses::parse_options(argc, argv, options); code >= 0) return code;
    const ThreadLimit threads(options.num_threads);
    const poses::CatalogEntry& entry = poses::find_sequence(options.name);
    const bool colored = entry.colored && options.colored;
    const auto sequence = entry.make(options.num_vertices);
    cli::Progress progress("writing " + options.name, "poses", options.num_poses, options.json);
    poses::write_obj_sequence(options.name, *sequence, options.num_poses, colored,
                              options.directory, [&] { progress.advance(); });
    progress.finish();
    report(options, sequence->topology(), colored);
    return 0;
}

}  // namespace

int main(int argc, char** argv) {
    return paim::cli::run_main("paim-poses", [&] { return run(argc, argv); });
}
