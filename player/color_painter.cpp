// Scales and colours.
#include "player/color_painter.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace paim::player {

namespace {

// Whether the end of the scale is the largest value that there is.
bool is_scaled_to_fit(SurfaceView view) {
    return view == SurfaceView::coefficient || is_error_view(view);
}

}  // namespace

ColorPainter::Subject ColorPainter::subject_of(const ViewState& view) {
    return {view.surface, view.coefficient, view.channel, view.limits};
}

SurfaceColors& ColorPainter::colors() {
    if (colors_ == nullptr) colors_ = std::make_unique<SurfaceColors>(asset_);
    return *colors_;
}

SurfaceQuery ColorPainter::query(double time, const DecodeLimits& limits) const {
    return {.view = view_.surface,
            .time = time,
            .limits = limits,
            .coefficient = view_.coefficient,
            .channel = view_.channel};
}

void ColorPainter::set_view(const ViewState& view, const LightCoefficients& light,
                            const DecodeLimits& most) {
    view_ = view;
    most_ = most;
    // The light counts in one view alone.
    if (view.surface != SurfaceView::radiance_error || light.values == light_.values) return;
    light_ = light;
    colors().set_light(DistantLight(light));
}

float ColorPainter::largest(const std::optional<double>& time) {
    const auto of = [&](const DecodeLimits& limits) {
        if (!time) return colors().sequence_scale(query(0.0, limits));
        return colors().paint(query(*time, limits)).legend.highest;
    };
    painted_.reset();
    const float limited = of(view_.limits);
    return view_.comparison == Comparison::none ? limited : std::max(limited, of(most_));
}

void ColorPainter::begin(const ViewState& view, double time, const LightCoefficients& light,
                         const DecodeLimits& most) {
    set_view(view, light, most);
    is_first_ = true;
    if (!is_scaled_to_fit(view.surface)) {
        scale_.reset();
        return;
    }
    if (scale_ && scale_->subject == subject_of(view)) return;
    const bool is_crowd = view.num_instances > 1;
    scale_ = {subject_of(view), largest(is_crowd ? std::nullopt : std::optional(time)), false};
}

void ColorPainter::fix_scale(const ViewState& view, const LightCoefficients& light,
                             const DecodeLimits& most) {
    if (!is_scaled_to_fit(view.surface)) return;
    set_view(view, light, most);
    scale_ = {subject_of(view), largest(std::nullopt), true};
}

// The first copy of a picture may make the scale larger. Values of the others, and of the other side of a
// comparison, that are beyond it have the colours of its ends.
const PartColors& ColorPainter::paint(double time, const DecodeLimits& limits) {
    const ColoredSurface* surface = &painted(time, limits);
    if (std::exchange(is_first_, false)) {
        if (scale_ && !scale_->is_fixed) {
            const float largest = largest_value(*surface);
            if (largest > scale_->highest) {
                scale_->highest = largest;
                surface = &painted(time, limits);
            }
        }
        legend_ = surface->legend;
    }
    return surface->colors;
}

const ColoredSurface& ColorPainter::painted(double time, const DecodeLimits& limits) {
    SurfaceQuery asked = query(time, limits);
    if (scale_) asked.scale = scale_->highest;
    Painted wanted{subject_of(view_), time, asked.scale, light_.values};
    wanted.subject.limits = limits;
    if (painted_ != wanted) {
        painted_.reset();
        surface_ = &colors().paint(asked);
        painted_ = std::move(wanted);
    }
    return *surface_;
}

// The largest magnitude, over vertices that a face has.
float ColorPainter::largest_value(const ColoredSurface& surface) {
    float largest = 0.0f;
    for (size_t part = 0; part < surface.values.size(); ++part) {
        for (const uint32_t v : colors().errors().counted(part)) {
            largest = std::max(largest, std::abs(surface.values[part][v]));
        }
    }
    return largest;
}

}  // namespace paim::player
