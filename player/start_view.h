// The view that a command line asks for.
#pragma once

#include "player/options.h"
#include "player/presenter.h"
#include "player/scene.h"

namespace paim::player {

// The view file, if there is one, then the options over it. The camera shows all of the animation unless
// either says otherwise. Errors: those of read_view().
// aspect  width / height of the picture
ViewState start_view(const Options& options, const Scene& scene, Presenter& presenter,
                     float aspect);

// Frames all of the animation, as far as the options and the camera's target do not say otherwise.
void frame_as_asked(const Options& options, const SceneUnits& units, Presenter& presenter,
                    float aspect, ViewState& view);

// The presenter of a scene within the options.
Presenter make_presenter(const Options& options, const Scene& scene);

}  // namespace paim::player
