// Filling in what panels show.
#include "player/ui/inspector.h"

#include <chrono>
#include <cmath>
#include <string>
#include <vector>

#include "player/view/framing.h"

namespace paim::player {

namespace {

std::optional<PicturePlace> place_of(Session& session, float aspect, const PickedVertex& vertex) {
    const ViewState& view = session.view;
    if (view.comparison == Comparison::side_by_side) return std::nullopt;
    Presenter& presenter = session.presenter();
    const Vec3f point = presenter.probe().position(presenter.time(view), view.limits, vertex);
    const std::optional<Vec3f> place = project(presenter.camera(view), aspect, point);
    // Beyond the split a wipe shows the whole file, which has no error.
    const bool is_hidden = view.comparison == Comparison::wipe && place && place->x() > view.split;
    if (!place || is_hidden) return std::nullopt;
    return PicturePlace{place->x(), place->y()};
}

// A view of the errors of vertices: that of the surface, if it is one.
SurfaceView error_view(const ViewState& view) {
    return is_error_view(view.surface) ? view.surface : SurfaceView::transfer_error;
}

void make_for(int bands, std::optional<LobeView>& lobe) {
    if (!lobe || lobe->bands() != bands) lobe.emplace(bands);
}

}  // namespace

bool Inspector::is_measuring() const {
    return history_ != nullptr && !history_->values().done();
}

bool Inspector::advance(Session& session) {
    constexpr std::chrono::milliseconds kShare(8);
    const ViewState& view = session.view;
    if (!view.picked) {
        history_.reset();
        return false;
    }
    const auto asset = session.presenter().shared_asset();
    const SurfaceView surface = error_view(view);
    if (history_ == nullptr || !history_->is_of(asset, *view.picked, surface, view.limits)) {
        history_ = std::make_unique<ErrorHistory>(asset, *view.picked, surface, view.limits,
                                                  session.presenter().light_of(view));
    }
    if (!is_measuring()) return false;
    history_->values().advance(kShare);
    return true;
}

void Inspector::describe(Session& session, const PanelState& state, float aspect, PanelInfo& info) {
    if (state.light_is_open) describe_light(session, info);
    describe_surface(session, aspect, info);
    if (session.view.picked) describe_picked(session, aspect, info);
}

void Inspector::describe_light(Session& session, PanelInfo& info) {
    Presenter& presenter = session.presenter();
    const ViewState& view = session.view;
    globe_.update(presenter.light(), presenter.camera(view).axes(),
                  static_cast<int>(view.limits.bands), view.tone_curve);
    info.globe_light = &globe_.light();
    info.globe_reconstruction = &globe_.reconstruction();
    info.negative_share = globe_.negative_share();
}

void Inspector::describe_surface(Session& session, float aspect, PanelInfo& info) {
    Presenter& presenter = session.presenter();
    const ViewState& view = session.view;
    if (!is_painted(view)) return;
    info.legend = presenter.painter().legend();
    if (info.legend != nullptr && info.legend->worst && info.legend->worst->value > 0.0f) {
        const Legend::Worst& worst = *info.legend->worst;
        info.worst = place_of(session, aspect, {worst.part, worst.vertex});
    }
    if (view.surface != SurfaceView::coefficient) return;
    make_for(static_cast<int>(session.range().limits.bands), coefficient_lobe_);
    std::vector<float> coefficients(view.coefficient + 1, 0.0f);
    coefficients.back() = 1.0f;
    coefficient_lobe_->update(coefficients, presenter.camera(view));
    info.coefficient_lobe = &coefficient_lobe_->texture();
}

void Inspector::describe_picked(Session& session, float aspect, PanelInfo& info) {
    Presenter& presenter = session.presenter();
    const ViewState& view = session.view;
    // While it plays, the lobe is that of every fourth part of a second: it takes a whole pose.
    double time = presenter.time(view);
    if (view.animation.playing) {
        const double step = std::max(1.0, 0.25 * double{session.asset().frames_per_second});
        time = std::floor(time / step) * step;
    }
    make_for(static_cast<int>(session.range().limits.bands), picked_lobe_);
    picked_lobe_->update(presenter.probe().transfer(time, view.limits, *view.picked),
                         presenter.camera(view));
    info.picked = PickedInfo{*view.picked, &picked_lobe_->texture(), {}, {}, 0};
    info.picked_place = place_of(session, aspect, *view.picked);
    if (history_ == nullptr) return;
    info.picked->history_title = std::string(row_of(history_->surface()).words);
    info.picked->history = history_->values().values();
    info.picked->num_poses = history_->values().times().size();
}

}  // namespace paim::player
