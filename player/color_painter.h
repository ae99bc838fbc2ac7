// Colours of the surface in views other than the lit one, with one scale for all of a picture.
#pragma once

#include <memory>
#include <optional>

#include "player/inspect/surface_colors.h"
#include "player/render/frame.h"
#include "player/view/view_state.h"

namespace paim::player {

class ColorPainter {
  public:
    explicit ColorPainter(std::shared_ptr<const Asset> asset) : asset_(std::move(asset)) {}

    // A picture of this view begins. When something else is shown than before, its scale is the largest
    // value at this moment or, in a crowd, of the whole animation; on both sides of a comparison. After
    // that it grows with the values, and never shrinks, so that colours do not flicker.
    // time   of the first copy
    // light  of the scene
    // most   limits that show the whole file
    void begin(const ViewState& view, double time, const LightCoefficients& light,
               const DecodeLimits& most);

    // Gives all pictures from now on the same scale, that of the whole animation
    // (SurfaceColors::sequence_scale()), until the view shows something else. Values beyond it have the
    // colours of its ends.
    void fix_scale(const ViewState& view, const LightCoefficients& light, const DecodeLimits& most);

    // The colours of all parts at a moment; valid until the next call. Nothing is computed if they are
    // those of the last call.
    const PartColors& paint(double time, const DecodeLimits& limits);

    // What the colours of the last picture mean; nullptr before the first.
    const Legend* legend() const { return legend_ ? &*legend_ : nullptr; }

  private:
    // What a scale belongs to.
    struct Subject {
        SurfaceView surface;
        uint32_t coefficient, channel;
        DecodeLimits limits;
        bool operator==(const Subject&) const = default;
    };
    struct Scale {
        Subject subject;
        float highest;
        bool is_fixed;
    };
    struct Painted {
        Subject subject;
        double time;
        std::optional<float> scale;
        std::vector<Vec3f> light;
        bool operator==(const Painted&) const = default;
    };
    static Subject subject_of(const ViewState& view);
    SurfaceQuery query(double time, const DecodeLimits& limits) const;
    SurfaceColors& colors();
    void set_view(const ViewState& view, const LightCoefficients& light, const DecodeLimits& most);
    // The largest value of all that is shown at a time, or ever.
    float largest(const std::optional<double>& time);
    const ColoredSurface& painted(double time, const DecodeLimits& limits);
    float largest_value(const ColoredSurface& surface);

    std::shared_ptr<const Asset> asset_;
    std::unique_ptr<SurfaceColors> colors_;  // made at first use
    ViewState view_;
    LightCoefficients light_;
    DecodeLimits most_;
    std::optional<Scale> scale_;
    std::optional<Legend> legend_;
    std::optional<Painted> painted_;  // what the colours are of
    const ColoredSurface* surface_ = nullptr;
    bool is_first_ = true;  // nothing of this picture has been painted
};

// Whether views of the surface need a ColorPainter.
constexpr bool is_painted(const ViewState& view) {
    return view.surface != SurfaceView::lit;
}

}  // namespace paim::player
