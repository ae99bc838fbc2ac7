// Words of view files and options.
#include "player/view/view_fields.h"

namespace paim::player {

Names<CameraTarget> camera_target_names() {
    return {
        {"all", CameraTarget::all}, {"pose", CameraTarget::pose}, {"point", CameraTarget::point}};
}

Names<Comparison> comparison_names() {
    return {{"none", Comparison::none},
            {"wipe", Comparison::wipe},
            {"side-by-side", Comparison::side_by_side}};
}

Names<Background::Kind> background_names() {
    return {{"env", Background::Kind::environment},
            {"blurred", Background::Kind::blurred},
            {"color", Background::Kind::color}};
}

Names<SurfaceView> surface_view_names() {
    Names<SurfaceView> names;
    for (const SurfaceViewRow& row : surface_views()) {
        names.emplace_back(std::string(row.name), row.view);
    }
    return names;
}

Names<GlossDetail> gloss_detail_names() {
    return {
        {"pixel", GlossDetail::pixel}, {"vertex", GlossDetail::vertex}, {"off", GlossDetail::none}};
}

}  // namespace paim::player
