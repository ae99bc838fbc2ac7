// A model and its scenery under a light before their background: all that one frame needs.
#pragma once

#include <memory>
#include <optional>

#include "paim/codec/model.h"
#include "paim/image/image.h"
#include "paim/light/environment.h"
#include "paim/light/light.h"
#include "player/gl/target.h"
#include "player/render/background_renderer.h"
#include "player/render/frame.h"
#include "player/render/model_renderer.h"

namespace paim::player {

class SceneRenderer {
  public:
    // Keeps a reference to the model; the environment is copied. Nothing beyond the limits is
    // uploaded. Errors (unsupported): the model does not fit into this driver's textures.
    // environment  lat-long, linear radiance; Error(bad input) if a value is negative or not finite
    SceneRenderer(const Model& model, const Image& environment, const DecodeLimits& limits);

    // Shows this model from now on, under the same light, and keeps a reference to it. On an error
    // the old one stays.
    void set_model(const Model& model, const DecodeLimits& limits);

    // Replaces light and background. On an error the old ones stay.
    void set_environment(const Image& environment);

    // The part of the model that is uploaded.
    const UploadPlan& plan() const { return model_renderer_->plan(); }

    // Of the model and its scenery.
    uint64_t texture_bytes() const {
        return model_renderer_->texture_bytes() +
               (scenery_renderer_ ? scenery_renderer_->texture_bytes() : 0);
    }

    // Draws into the target.
    void draw(const Frame& frame, const gl::Target& target);

    // The picture of width × height pixels, each the mean of samples × samples.
    Image render(const Frame& frame, int width, int height, int samples);

  private:
    void project_light();

    std::unique_ptr<ModelRenderer> model_renderer_;
    std::unique_ptr<Model> scenery_;  // as an animation that does not move, if the model has any
    std::unique_ptr<ModelRenderer> scenery_renderer_;
    BackgroundRenderer background_renderer_;
    std::optional<EnvironmentLight> environment_;
    LightCoefficients light_;         // not turned
    LightCoefficients turned_light_;  // by turned_rad_
    double turned_rad_ = 0.0;
};

}  // namespace paim::player
