// --bench.
#include "player/bench.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <functional>
#include <limits>
#include <utility>
#include <vector>

#include "paim/base/json_text.h"
#include "paim/base/parallel.h"
#include "paim/codec/playback.h"
#include "paim/light/environment.h"
#include "player/file_prefix.h"
#include "player/gl/check.h"
#include "player/gl/headless_context.h"
#include "player/prefix_loader.h"
#include "player/render/codec_words.h"
#include "player/render/cost.h"
#include "player/render/scene_renderer.h"
#include "player/report.h"

namespace paim::player {

namespace {

using Clock = std::chrono::steady_clock;

constexpr int kWarmUpFrames = 3;

struct Times {
    double median_ms;
    double min_ms;
};

Times measure(int num_frames, const std::function<void(int)>& draw_frame) {
    for (int i = 0; i < std::min(kWarmUpFrames, num_frames); ++i) draw_frame(i);
    std::vector<double> times_ms;
    for (int i = 0; i < num_frames; ++i) {
        const auto start = Clock::now();
        draw_frame(i);
        times_ms.push_back(std::chrono::duration<double, std::milli>(Clock::now() - start).count());
    }
    std::sort(times_ms.begin(), times_ms.end());
    return {times_ms[times_ms.size() / 2], times_ms[0]};
}

// Frame i of the benchmark: fractional poses, and a light that turns once.
void set_frame(Frame& frame, const Scene& scene, int i, int num_frames) {
    frame.time = std::fmod(0.37 * i, static_cast<double>(scene.asset->num_poses()));
    set_light(frame, scene, 2.0 * kPi * i / num_frames);
}

// Uploads weights and light, draws and waits until the picture is finished.
// target  of the size of a tile
Times measure_gpu(SceneRenderer& renderer, const Scene& scene, Frame frame, const Tiling& tiling,
                  const gl::Target& target, int num_frames, bool still) {
    const Times times = measure(num_frames, [&](int i) {
        if (!still) set_frame(frame, scene, i, num_frames);
        renderer.draw_tiles(frame, tiling, target);
        glFinish();
    });
    gl::check_errors("drawing");
    return times;
}

// The same weights, decoding, turned light and shading; no picture.
Times measure_cpu(const Options& options, const Scene& scene, Frame frame) {
    Playback playback(scene.asset);
    const int num_frames = *options.bench_frames;
    return measure(num_frames, [&](int i) {
        set_frame(frame, scene, i, num_frames);
        playback.set_light(DistantLight(frame.light));
        playback.update(frame.time, frame.limits);
    });
}

// From opening the file to a finished picture.
struct Opening {
    double ms = 0.0;
    uint64_t bytes = 0;  // of the file that were read
};

// Opens the file as a window does, and draws the first frame of what it shows first, or of all of the
// file. The context is there, but no shader.
// most_bytes  that are read, unless the shortest prefix has more
Opening measure_opening(const Options& options, const Scene& scene, uint64_t most_bytes) {
    const auto start = Clock::now();
    const FilePrefix prefix = inspect_prefix(options.model_path);
    const uint64_t bytes = prefix.playable_bytes(0, most_bytes);
    const LoadedAsset loaded = read_prefix(options.model_path, prefix, bytes);
    const Scene opened{
        loaded.asset, scene.environment, scene.light, bounds_so_far(*loaded.asset), 0, {}};
    SceneRenderer renderer(opened.asset, options.limits, options.decoder);
    renderer.set_environment(opened.environment.image());
    const auto [width, height] = options.size;
    const int samples = options.supersample.value_or(1);
    const Tiling tiling = plan_tiles(width, height, samples, gl::max_target_size());
    const gl::Target target(tiling.tile_width * samples, tiling.tile_height * samples);
    renderer.draw_tiles(first_frame(options, opened), tiling, target);
    glFinish();
    gl::check_errors("drawing");
    return {std::chrono::duration<double, std::milli>(Clock::now() - start).count(), bytes};
}

}  // namespace

void run_bench(const Options& options, const Scene& scene) {
    const auto context = gl::make_headless_context();
    const Opening first = measure_opening(options, scene, LoaderPace::kFirstBytes);
    const Opening whole_file =
        measure_opening(options, scene, std::numeric_limits<uint64_t>::max());
    const int samples = options.supersample.value_or(1);
    Frame frame = first_frame(options, scene);
    frame.bounds.extend(scene.bounds.lower);  // of every pose
    frame.bounds.extend(scene.bounds.upper);
    SceneRenderer renderer(scene.asset, options.limits, options.decoder);
    renderer.set_environment(scene.environment.image());
    const auto [width, height] = options.size;
    const Tiling tiling = plan_tiles(width, height, samples, gl::max_target_size());
    const gl::Target target(tiling.tile_width * samples, tiling.tile_height * samples);
    const gl::Target pixel(1, 1);  // so that almost all of the work is that of the vertices
    const int num_frames = *options.bench_frames;
    const auto measure_frames = [&](const Tiling& tiles, const gl::Target& into, bool still) {
        return measure_gpu(renderer, scene, frame, tiles, into, num_frames, still);
    };
    const Times whole = measure_frames(tiling, target, false);
    const Times still = measure_frames(tiling, target, true);
    const Times vertices = measure_frames({1, 1, 1, 1}, pixel, false);
    const Times still_vertices = measure_frames({1, 1, 1, 1}, pixel, true);
    const Times cpu = measure_cpu(options, scene, frame);
    const double ratio = vertices.median_ms / cpu.median_ms;
    const int num_threads = max_parallelism();

    if (options.json) {
        nlohmann::ordered_json json =
            describe_frame(options, scene, renderer, context->description(), samples);
        json["first_picture_ms"] = first.ms;
        json["first_picture_bytes"] = first.bytes;
        json["whole_picture_ms"] = whole_file.ms;
        json["frames"] = num_frames;
        json["frame_median_ms"] = whole.median_ms;
        json["frame_min_ms"] = whole.min_ms;
        json["vertices_median_ms"] = vertices.median_ms;
        json["vertices_min_ms"] = vertices.min_ms;
        json["cpu_median_ms"] = cpu.median_ms;
        json["cpu_min_ms"] = cpu.min_ms;
        json["cpu_threads"] = num_threads;
        json["vertices_to_cpu_ratio"] = ratio;
        fmt::print("{}\n", json_text(json, 2));
        return;
    }
    const auto print = [](const char* what, const Times& times) {
        fmt::print("{:<38} {:9.3f} ms median, {:9.3f} ms least\n", what, times.median_ms,
                   times.min_ms);
    };
    fmt::print("{}\n{} frames of {} x {} samples, {} vertices\n", context->description(),
               num_frames, width * samples, height * samples,
               scene.asset->moving().topology.num_vertices);
    const Cost cost = frame_cost(scene.asset->moving(), options.limits);
    fmt::print("{:.3f} MB of textures, {} multiply-adds a vertex, positions included",
               1e-6 * static_cast<double>(renderer.texture_bytes()), cost.multiply_adds);
    const CodecWords* const words = words_of_codec(scene.asset->moving().transfer->codec_name());
    if (words != nullptr && cost.cpu_multiply_adds > 0) {
        fmt::print(", {} a frame for {}", cost.cpu_multiply_adds, words->shared_work);
    }
    fmt::print("\n");
    fmt::print("{:<38} {:9.3f} ms, of {:.1f} MB; {:.3f} ms of the whole file\n",
               "from opening to the first picture", first.ms,
               1e-6 * static_cast<double>(first.bytes), whole_file.ms);
    print("whole frame", whole);
    print("frame of one pixel: the vertices", vertices);
    print("whole still", still);
    print("still vertices", still_vertices);
    print(fmt::format("decoding and shading, {} CPU threads", num_threads).c_str(), cpu);
    fmt::print("vertices to CPU, ratio of the medians  {:9.3f}\n", ratio);
}

}  // namespace paim::player
