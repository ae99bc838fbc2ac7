// paim-play: plays a .paim under a light that can be changed and turned.
#include <utility>

#include "paim/cli/run_main.h"
#include "player/app.h"
#include "player/bench.h"
#include "player/clip.h"
#include "player/options.h"
#include "player/scene.h"
#include "player/snapshot.h"

int main(int argc, char** argv) {
    using namespace paim::player;
    return paim::cli::run_main("paim-play", [&] {
        Options options;
        if (const int code = parse_options(argc, argv, options); code >= 0) return code;
        if (options.opens_window() && (options.play_prefix || is_large(options.model_path))) {
            run_app_from_prefix(options);
            return 0;
        }
        Scene scene = load_scene(options);
        if (options.snapshot_path) {
            take_snapshot(options, scene);
        } else if (options.clip) {
            write_clip(options, scene);
        } else if (options.bench_frames) {
            run_bench(options, scene);
        } else {
            run_app(options, std::move(scene));
        }
        return 0;
    });
}
