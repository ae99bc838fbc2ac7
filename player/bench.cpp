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
#include "player/file_prefix.h"
#include "player/gl/check.h"
#include "player/gl/headless_context.h"
#include "player/inspect/cost.h"
#include "player/prefix_loader.h"
#include "player/render/codec_words.h"
#include "player/report.h"
#include "player/start_view.h"

namespace paim::player {

namespace {

using Clock = std::chrono::steady_clock;

constexpr int kWarmUpFrames = 3;

double elapsed_ms(Clock::time_point start) {
    return std::chrono::duration<double, std::milli>(Clock::now() - start).count();
}

// Times of the same work, again and again.
class Times {
  public:
    void add(double time_ms) { times_ms_.push_back(time_ms); }
    double median_ms() const { return quantile_ms(0.5); }
    double p99_ms() const { return quantile_ms(0.99); }
    double least_ms() const { return quantile_ms(0.0); }

  private:
    double quantile_ms(double share) const {
        std::vector<double> sorted = times_ms_;
        std::sort(sorted.begin(), sorted.end());
        return sorted[static_cast<size_t>(share * static_cast<double>(sorted.size() - 1) + 0.5)];
    }

    std::vector<double> times_ms_;
};

// Frames as they are played, and the same frames drawn again, of which nothing has to be decoded: those
// of a mesh that stands still and has colours. They take turns, so that both meet the same load.
struct FrameTimes {
    Times played, still;

    double ratio() const { return played.median_ms() / still.median_ms(); }
};

// Frame i of the benchmark: fractional poses, and a light that turns once.
ViewState view_of_frame(const ViewState& start, const Asset& asset, int i, int num_frames) {
    ViewState view = start;
    view.animation.time = std::fmod(0.37 * i, static_cast<double>(asset.num_poses()));
    view.light.orientation.yaw_deg = 360.0 * i / num_frames;
    return view;
}

// Draws and waits until the picture is finished.
// target  of the size of a tile
FrameTimes measure_gpu(Presenter& presenter, const ViewState& start, const Tiling& tiling,
                       const gl::Target& target, int num_frames) {
    FrameTimes times;
    for (int i = -std::min(kWarmUpFrames, num_frames); i < num_frames; ++i) {
        const Frame frame =
            presenter.frame(view_of_frame(start, presenter.asset(), std::abs(i), num_frames));
        for (Times* const of : {&times.played, &times.still}) {
            const auto begin = Clock::now();
            presenter.renderer().draw_tiles(frame, tiling, target);
            glFinish();
            if (i >= 0) of->add(elapsed_ms(begin));
        }
    }
    gl::check_errors("drawing");
    return times;
}

// The same weights, decoding, turned light and shading; no picture.
Times measure_cpu(Presenter& presenter, const std::shared_ptr<const Asset>& asset,
                  const ViewState& start, int num_frames) {
    Times times;
    Playback playback(asset);
    for (int i = -std::min(kWarmUpFrames, num_frames); i < num_frames; ++i) {
        const Frame frame = presenter.frame(view_of_frame(start, *asset, std::abs(i), num_frames));
        const auto begin = Clock::now();
        playback.set_light(DistantLight(frame.light));
        playback.update(frame.time, frame.limits);
        if (i >= 0) times.add(elapsed_ms(begin));
    }
    return times;
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
    LoadedAsset loaded = read_prefix(options.model_path, prefix, bytes);
    Scene opened{
        loaded.asset, scene.environment, loaded.units, bounds_so_far(*loaded.asset), 0, {}};
    Presenter presenter = make_presenter(options, opened);
    const auto [width, height] = options.size;
    const ViewState view = start_view(options, opened, presenter,
                                      static_cast<float>(width) / static_cast<float>(height));
    const int samples = options.window_samples();
    const Tiling tiling = plan_tiles(width, height, samples, gl::max_target_size());
    const gl::Target target(tiling.tile_width * samples, tiling.tile_height * samples);
    presenter.renderer().draw_tiles(presenter.frame(view), tiling, target);
    glFinish();
    gl::check_errors("drawing");
    return {elapsed_ms(start), bytes};
}

struct BenchResult {
    Opening first, whole_file;
    FrameTimes frames, vertices;
    Times cpu;
};

void add_times(const std::string& name, const Times& times, nlohmann::ordered_json& json) {
    json[name + "_median_ms"] = times.median_ms();
    json[name + "_p99_ms"] = times.p99_ms();
    json[name + "_min_ms"] = times.least_ms();
}

void add_result(const BenchResult& result, nlohmann::ordered_json& json) {
    json["first_picture_ms"] = result.first.ms;
    json["first_picture_bytes"] = result.first.bytes;
    json["whole_picture_ms"] = result.whole_file.ms;
    add_times("frame", result.frames.played, json);
    add_times("still_frame", result.frames.still, json);
    json["frame_to_still_ratio"] = result.frames.ratio();
    add_times("vertices", result.vertices.played, json);
    add_times("still_vertices", result.vertices.still, json);
    json["vertices_to_still_ratio"] = result.vertices.ratio();
    add_times("cpu", result.cpu, json);
    json["cpu_threads"] = max_parallelism();
    json["vertices_to_cpu_ratio"] = result.vertices.played.median_ms() / result.cpu.median_ms();
}

void print_result(const BenchResult& result) {
    const auto print = [](const std::string& what, const Times& times) {
        fmt::print("{:<44} {:9.3f} ms median, {:9.3f} ms 99th percentile, {:9.3f} ms least\n", what,
                   times.median_ms(), times.p99_ms(), times.least_ms());
    };
    fmt::print("{:<44} {:9.3f} ms, of {:.1f} MB; {:.3f} ms of the whole file\n",
               "from opening to the first picture", result.first.ms,
               1e-6 * static_cast<double>(result.first.bytes), result.whole_file.ms);
    print("whole frame", result.frames.played);
    print("whole frame of a mesh that stands still", result.frames.still);
    print("frame of one pixel: the vertices", result.vertices.played);
    print("frame of one pixel, standing still", result.vertices.still);
    print(fmt::format("decoding and shading, {} CPU threads", max_parallelism()), result.cpu);
    fmt::print("whole frame to one standing still, ratio of the medians  {:.3f}\n",
               result.frames.ratio());
    fmt::print("vertices to those standing still, ratio of the medians   {:.3f}\n",
               result.vertices.ratio());
    fmt::print("vertices to CPU, ratio of the medians                    {:.3f}\n",
               result.vertices.played.median_ms() / result.cpu.median_ms());
}

}  // namespace

void run_bench(const Options& options, const Scene& scene) {
    const auto context = gl::make_headless_context();
    BenchResult result;
    result.first = measure_opening(options, scene, LoaderPace::kFirstBytes);
    result.whole_file = measure_opening(options, scene, std::numeric_limits<uint64_t>::max());
    const auto [width, height] = options.size;
    const int samples = options.window_samples();
    const int num_frames = *options.bench_frames;
    Presenter presenter = make_presenter(options, scene);
    const ViewState view = start_view(options, scene, presenter,
                                      static_cast<float>(width) / static_cast<float>(height));
    const Tiling tiling = plan_tiles(width, height, samples, gl::max_target_size());
    const gl::Target target(tiling.tile_width * samples, tiling.tile_height * samples);
    const gl::Target pixel(1, 1);  // so that almost all of the work is that of the vertices
    result.frames = measure_gpu(presenter, view, tiling, target, num_frames);
    result.vertices = measure_gpu(presenter, view, {1, 1, 1, 1}, pixel, num_frames);
    result.cpu = measure_cpu(presenter, scene.asset, view, num_frames);

    if (options.json) {
        nlohmann::ordered_json json =
            describe_picture(options, scene, presenter, view, context->description(), samples);
        json["frames"] = num_frames;
        add_result(result, json);
        fmt::print("{}\n", json_text(json, 2));
        return;
    }
    const CodedMesh& mesh = scene.asset->moving();
    fmt::print("{}\n{} frames of {} x {} samples, {} vertices\n", context->description(),
               num_frames, width * samples, height * samples, mesh.topology.num_vertices);
    const Cost cost = frame_cost(mesh, view.limits);
    const SceneRenderer& renderer = presenter.renderer();
    fmt::print(
        "{:.3f} MB of textures, {:.3f} MB of attributes and triangles, {} multiply-adds a "
        "vertex, positions included",
        1e-6 * static_cast<double>(renderer.texture_bytes()),
        1e-6 * static_cast<double>(renderer.buffer_bytes()), cost.multiply_adds);
    const CodecWords* const words = words_of_codec(mesh.transfer->codec_name());
    if (words != nullptr && cost.cpu_multiply_adds > 0) {
        fmt::print(", {} a frame for {}", cost.cpu_multiply_adds, words->shared_work);
    }
    fmt::print("\n");
    print_result(result);
}

}  // namespace paim::player
