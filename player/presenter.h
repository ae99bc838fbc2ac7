// From a view to its picture: for windows, files and measurements alike.
#pragma once

#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "paim/codec/asset.h"
#include "paim/codec/mesh_decoder.h"
#include "paim/image/image.h"
#include "player/gl/target.h"
#include "player/inspect/surface_colors.h"
#include "player/inspect/vertex_history.h"
#include "player/light/light_rig.h"
#include "player/render/scene_renderer.h"
#include "player/view/body_path.h"
#include "player/view/pose_bounds_cache.h"
#include "player/view/view_state.h"

namespace paim::player {

class Presenter {
  public:
    // limits  what is uploaded; views cannot show more
    // reach   bounds of all poses of the asset
    // Errors: those of SceneRenderer.
    Presenter(std::shared_ptr<const Asset> asset, const Bounds& reach, EnvironmentLight environment,
              const DecodeLimits& limits, Decoder decoder);

    // Shows this asset from now on, under the same light. On an error the old one stays.
    void set_asset(std::shared_ptr<const Asset> asset, const Bounds& reach,
                   const DecodeLimits& limits);
    void set_environment(EnvironmentLight environment);

    const Asset& asset() const { return *asset_; }
    std::shared_ptr<const Asset> shared_asset() const { return asset_; }
    const Bounds& reach() const { return reach_; }
    ViewRange range() const { return {asset_->num_poses(), renderer_.most()}; }
    SceneRenderer& renderer() { return renderer_; }
    const SceneRenderer& renderer() const { return renderer_; }
    // What renderer() draws of the view within its limits.
    Frame frame(const ViewState& view) { return frame(view, view.limits); }
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

    // What the colours of the view that was drawn last mean; nothing where it was lit.
    const Legend* legend() const { return legend_ ? &*legend_ : nullptr; }
    // Gives all pictures from now on the same scale, that of the whole sequence
    // (SurfaceColors::sequence_scale()). Values beyond it have the colours of its ends. Until the view
    // shows something else.
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

    // The nearest vertex of what is seen in this place of the picture, of the first copy; nothing if there
    // is none.
    // x, y  0 … 1 from the upper left corner
    std::optional<PickedVertex> pick(const ViewState& view, float x, float y, float aspect);
    // Where a vertex is in the scene.
    Vec3f position_of(const ViewState& view, const PickedVertex& vertex);
    // Its transfer, luminance, by coefficient, in the axes of the scene; bands beyond the view's are
    // zero.
    std::vector<float> transfer_of(const ViewState& view, const PickedVertex& vertex);
    // Its error at every pose, of the kind that this view of the surface shows. Refers to this object
    // until set_asset().
    VertexHistory history(const ViewState& view, SurfaceView error_view);

  private:
    void set_light(const ViewState& view);
    // A part within the limits of the view, positions in the scene. Valid until the next call for this
    // part.
    const DecodedPose& decoded(const ViewState& view, size_t part);
    Frame frame(const ViewState& view, const DecodeLimits& limits);
    std::vector<Instance> crowd(const ViewState& view) const;
    Bounds bounds(const ViewState& view, const std::vector<Instance>& instances);
    const PartColors& paint(const ViewState& view, const DecodeLimits& limits, double time);
    const ColoredSurface& paint_scaled(const ViewState& view, SurfaceQuery query);

    // What a scale of colours belongs to.
    struct ScaleKey {
        SurfaceView surface;
        uint32_t coefficient, channel;
        DecodeLimits limits;
        bool operator==(const ScaleKey&) const = default;
    };
    static ScaleKey scale_key(const ViewState& view);
    struct Scale {
        ScaleKey key;
        float highest;
        bool is_fixed;
    };
    float scale_of_all(const ViewState& view, bool at_all_times);
    float largest_value(const ColoredSurface& surface);
    void set_color_light();

    std::shared_ptr<const Asset> asset_;
    Bounds reach_;
    LightRig rig_;
    SceneRenderer renderer_;
    std::unique_ptr<SurfaceColors> colors_;
    // Of each part, made at first use: what was decoded last.
    struct Decoded {
        MeshDecoder decoder;
        DecodedPose pose;
        std::optional<double> time;
        DecodeLimits limits;
    };
    std::vector<Decoded> decoded_;
    std::optional<PoseBoundsCache> pose_bounds_;
    std::optional<BodyPath> path_;
    std::optional<Legend> legend_;
    // Of the next picture: one picture has one scale. It never shrinks while the same thing is shown, so
    // that colours do not flicker.
    std::optional<Scale> scale_;
};

}  // namespace paim::player
