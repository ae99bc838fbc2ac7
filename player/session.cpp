// Opening and replacing.
#include "player/session.h"

#include <algorithm>
#include <chrono>
#include <system_error>
#include <utility>

#include "paim/base/error.h"
#include "paim/codec/sequence_bounds.h"
#include "paim/format/container/container_reader.h"
#include "paim/format/container/sections.h"
#include "paim/light/load_light.h"
#include "player/read_asset.h"
#include "player/start_view.h"

namespace paim::player {

namespace {

LoadedAsset read_whole(const std::filesystem::path& path) {
    LoadedAsset loaded;
    loaded.asset = read_asset(path, {}, &loaded.units);
    loaded.bounds = sequence_bounds(*loaded.asset);
    std::error_code ignored;
    loaded.progress.size_bytes = std::filesystem::file_size(path, ignored);
    return loaded;
}

}  // namespace

bool is_large(const std::filesystem::path& path) {
    std::error_code error;
    const uintmax_t size_bytes = std::filesystem::file_size(path, error);
    return !error && size_bytes > LoaderPace::kFirstBytes;
}

std::unique_ptr<PrefixLoader> start_loading(const std::filesystem::path& path, bool play_prefix) {
    LoaderPace pace;
    pace.whole = !play_prefix;
    // A file that is cut short is refused at once.
    if (pace.whole) const ContainerReader checked(path, section::kKindAnimation);
    return std::make_unique<PrefixLoader>(path, pace);
}

Session::Session(const Options& options, Scene scene, std::unique_ptr<PrefixLoader> loader,
                 float aspect)
    : options_(options),
      model_path_(options.model_path),
      environment_name_(options.environment_path ? options.environment_path->filename().string()
                                                 : "built-in sky"),
      units_(scene.units),
      file_bytes_(scene.size_bytes),
      loader_(std::move(loader)) {
    // All of the model, so that limits can be raised again.
    presenter_ =
        std::make_unique<Presenter>(scene.asset, scene.bounds, scene.environment, DecodeLimits(),
                                    options.wanted.limits(), options.decoder);
    view = start_view(options, scene, *presenter_, aspect);
    camera_moved_ = options.view_path.has_value();
}

std::string Session::loading() const {
    if (loader_ == nullptr || asset().complete) return {};
    return progress_text(loader_->progress());
}

std::string Session::open(const std::filesystem::path& path, float aspect) {
    return path.extension() == ".paim" ? open_model(path, aspect) : open_light(path);
}

std::string Session::open_model(const std::filesystem::path& path, float aspect) {
    std::unique_ptr<PrefixLoader> loader;
    LoadedAsset loaded;
    if (is_large(path)) {
        loader = start_loading(path, false);
        loaded = loader->wait_for_first([] {});
    } else {
        loaded = read_whole(path);
    }
    show(std::move(loaded));
    loader_ = std::move(loader);
    model_path_ = path;
    is_first_model_ = false;
    start_anew(aspect);
    return "model: " + path.filename().string();
}

std::string Session::open_light(const std::filesystem::path& path) {
    const LoadedLight light = load_light(path, options_.env_mapping);
    presenter_->set_environment(light.light);
    environment_name_ = path.filename().string();
    std::string message = "light: " + environment_name_;
    for (const std::string& note : light.notes) message += "\n" + note;
    return message;
}

void Session::show(LoadedAsset loaded) {
    presenter_->set_asset(loaded.asset, loaded.bounds, {}, options_.wanted.limits());
    units_ = loaded.units;
    file_bytes_ = loaded.progress.size_bytes;
    accuracy_.reset();
}

// The view of another model: all of its detail, from its first pose.
void Session::start_anew(float aspect) {
    view.limits = range().limits;
    view.coefficient = std::min(view.coefficient, view.limits.bands * view.limits.bands - 1);
    view.animation.time = 0.0;
    view.picked.reset();
    camera_moved_ = false;
    frame(aspect, false);
}

bool Session::take_more(float aspect, std::string& message) {
    if (loader_ == nullptr) return false;
    try {
        loader_->check();
    } catch (const Error& error) {
        if (is_first_model_) throw;
        // A file that somebody opened in the window: what was read of it stays.
        message = error.what();
        loader_.reset();
        return true;
    }
    message = loader_->take_error();
    std::optional<LoadedAsset> loaded = loader_->take();
    if (!loaded) return !message.empty();
    const ViewRange before = range();
    const bool replaced = loaded->replaced;
    try {
        show(std::move(*loaded));
    } catch (const Error& error) {
        message = error.what();
        return true;
    }
    follow(view, before, range(), options_.wanted.limits());
    if (replaced) view.picked.reset();
    // Coarse poses have other bounds. A camera that somebody has moved stays.
    const bool sharpens = !options_.play_prefix && !camera_moved_;
    if (replaced || sharpens) frame_as_asked(options_, units_, *presenter_, aspect, view);
    return true;
}

void Session::read_on() {
    if (loader_ != nullptr) loader_->read_on();
}

void Session::frame(float aspect, bool pose_alone) {
    if (view.camera.target == CameraTarget::point) view.camera.target = CameraTarget::all;
    view.camera.orbit = presenter_->framed(view, aspect, pose_alone);
}

void Session::follow_body(bool follows) {
    const Vec3d before = presenter_->camera_origin(view);
    view.camera.target = follows ? CameraTarget::pose : CameraTarget::all;
    view.camera.orbit.target += before - presenter_->camera_origin(view);
}

const AccuracyMeter* Session::accuracy_meter() {
    if (accuracy_ != nullptr || !asset().complete) return accuracy_.get();
    if (!measuring_.valid()) {
        measured_ = presenter_->shared_asset();
        measuring_ = std::async(std::launch::async, [asset = measured_] {
            return std::make_unique<AccuracyMeter>(asset);
        });
    }
    if (measuring_.wait_for(std::chrono::seconds(0)) != std::future_status::ready) return nullptr;
    auto meter = measuring_.get();
    // Another model may be shown by now.
    if (measured_ == presenter_->shared_asset()) accuracy_ = std::move(meter);
    measured_.reset();
    return accuracy_.get();
}

}  // namespace paim::player
