// From a view to its picture: for windows, files and measurements alike.
#pragma once

#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "paim/codec/asset.h"
#include "paim/image/image.h"
#include "player/color_painter.h"
#include "player/gl/target.h"
#include "player/light/light_rig.h"
#include "player/render/scene_renderer.h"
#include "player/vertex_probe.h"
#include "player/view/body_path.h"
#include "player/view/pose_bounds_cache.h"
#include "player/view/view_state.h"

namespace paim::player {

class Presenter {
  public:
    // limits, fewer  what is uploaded (SceneRenderer); views cannot show more
    // reach          bounds of all poses of the asset
    // Errors: those of SceneRenderer.
    Presenter(std::shared_ptr<const Asset> asset, const Bounds& reach, EnvironmentLight environment,
              const DecodeLimits& limits, const DecodeLimits& fewer, Decoder decoder);

    // Shows this asset from now on, under the same light. On an error the old one stays.
    void set_asset(std::shared_ptr<const Asset> asset, const Bounds& reach,
                   const DecodeLimits& limits, const DecodeLimits& fewer);
    void set_environment(EnvironmentLight environment);

    const Asset& asset() const { return *asset_; }
    std::shared_ptr<const Asset> shared_asset() const { return asset_; }
    const Bounds& reach() const { return reach_; }
    ViewRange range() const { return {asset_->num_poses(), renderer_.most()}; }
    SceneRenderer& renderer() { return renderer_; }
    const SceneRenderer& renderer() const { return renderer_; }
    // What renderer() draws of the view within its limits.
    Frame frame(const ViewState& view) { return frames(view).front(); }
    // The light as the last view has set it.
    LightRig& light() { return rig_; }

    // Draws the view into the target, as linear radiance or display values; both pictures of a
    // comparison.
    void draw(const ViewState& view, const gl::Target& target);
    // The same picture of width × height pixels, each the mean of samples × samples.
    Image render(const ViewState& view, int width, int height, int samples);

    // How the picture is displayed: as the view says where it is lit. Colours that stand for numbers
    // are shown as they are.
    static ToneCurve tone_curve(const ViewState& view);

    // The colours of views other than the lit one.
    const ColorPainter& painter() const { return *painter_; }
    // Gives all pictures from now on the same scale of colours (ColorPainter::fix_scale()).
    void fix_scale(const ViewState& view);

    Camera camera(const ViewState& view);
    // The moment that is shown.
    double time(const ViewState& view) const;
    // Where the camera's target is relative to.
    Vec3d camera_origin(const ViewState& view);
    // The camera from the same direction that sees all poses, or the pose that is shown.
    OrbitCamera framed(const ViewState& view, float aspect, bool pose_alone);

    // The exposure that suits the surface as it is lit now.
    float suitable_exposure_ev(const ViewState& view);

    // The vertex of the first copy that is seen in this place of the picture; nothing if there is none.
    // x, y  0 … 1 from the upper left corner
    std::optional<PickedVertex> pick(const ViewState& view, float x, float y, float aspect);
    VertexProbe& probe() { return *probe_; }

    // Incident light of the view, in all bands that the model has.
    const LightCoefficients& light_of(const ViewState& view);

  private:
    void show(std::shared_ptr<const Asset> asset, const Bounds& reach);
    std::vector<Frame> frames(const ViewState& view);
    Frame frame(const ViewState& view, const DecodeLimits& limits);
    std::vector<Instance> crowd(const ViewState& view) const;

    std::shared_ptr<const Asset> asset_;
    Bounds reach_;
    LightRig rig_;
    SceneRenderer renderer_;
    std::unique_ptr<ColorPainter> painter_;
    std::unique_ptr<VertexProbe> probe_;
    std::optional<PoseBoundsCache> limited_bounds_, whole_bounds_;
    std::optional<BodyPath> path_;
};

}  // namespace paim::player
