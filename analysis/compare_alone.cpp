// Files side by side without their bake.
#include "analysis/compare_alone.h"

#include <fmt/format.h>

#include <algorithm>

#include "analysis/analyze.h"
#include "analysis/compare/unlike_files.h"
#include "analysis/page.h"
#include "analysis/stable_time.h"
#include "paim/base/error.h"
#include "paim/base/file.h"
#include "paim/base/json_text.h"
#include "paim/base/tbb_parallel.h"
#include "paim/cli/progress.h"
#include "paim/format/bake/bake_directory.h"
#include "paim/format/paim/paim_read.h"

namespace paim {

namespace {

std::string title_of(const std::vector<UnlikeFile>& files) {
    std::string names;
    for (const UnlikeFile& file : files) {
        names += (names.empty() ? "" : ", ") + file.path.filename().string();
    }
    return names;
}

void say_answers(const std::vector<UnlikeFile>& files, const std::vector<NamedLight>& lights) {
    for (size_t j = 0; j < files.size(); ++j) {
        std::string line =
            fmt::format("{}: {} bytes", files[j].path.filename().string(), files[j].size_bytes);
        for (size_t light = 0; j > 0 && light < lights.size(); ++light) {
            line += fmt::format(", {} unlike the first file under {}",
                                percent_text(files[j].differences[light].visual_error()),
                                lights[light].name);
        }
        fmt::print("{}\n", line);
    }
    fmt::print("no truth is known without the bake: differences do not say which file is right\n");
}

}  // namespace

void compare_alone(const AnalyzeOptions& options) {
    const ThreadLimit limit(options.num_threads);
    uint32_t bands = 1;
    for (const std::filesystem::path& path : options.compare) {
        for (const CodedMesh& part : read_paim(path).parts)
            bands = std::max(bands, part.light_bands());
    }
    const std::vector<NamedLight> lights =
        load_lights(options.environments, options.env_mapping, bands);
    check_picture_memory(options, lights.size());
    if (is_bake(options.output)) {
        throw_usage("--output {}: is a bake, expected another directory", options.output.string());
    }
    ensure_directory(options.output);
    cli::Progress progress("comparing", "steps",
                           unlike_steps(options.compare.size(), options.stage),
                           options.quiet || options.json);
    const std::vector<UnlikeFile> files =
        compare_played(options.compare, lights, options.stage, [&] { progress.advance(); });
    progress.finish();
    write_file(options.output / "compare.csv", unlike_csv(files, lights));
    Page page(options.output, "Files side by side", title_of(files));
    add_unlike(page, files, lights);
    page.write();
    if (options.json) {
        nlohmann::ordered_json json{{"directory", options.output.string()},
                                    {"machine", machine_name()},
                                    {"compare", unlike_json(files, lights)}};
        fmt::print("{}\n", json_text(json, 2));
        return;
    }
    say_answers(files, lights);
    fmt::print("{}\n", (options.output / "index.html").string());
}

}  // namespace paim
