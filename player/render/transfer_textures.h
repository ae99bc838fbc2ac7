// Transfer in textures, of either codec, and the light that it meets.
#pragma once

#include <memory>
#include <string>

#include "paim/codec/asset.h"
#include "paim/light/light.h"
#include "player/gl/program.h"
#include "player/render/frame.h"
#include "player/render/upload_plan.h"

namespace paim::player {

class TransferTextures {
  public:
    virtual ~TransferTextures() = default;

    // What chooses the part of shaders/model.vert that reads these textures.
    virtual std::string defines() const = 0;
    virtual uint64_t size_bytes() const = 0;

    // Uploads what changes with time and light, hands textures and counts to the program, which is
    // in use, and returns the first texture unit that is free after those from `unit`.
    virtual int bind(const gl::Program& program, int unit, const Frame& frame,
                     const LightCoefficients& light) = 0;
};

// Uploads the model's transfer as planned. Keeps a reference to the model for what changes.
std::unique_ptr<TransferTextures> make_transfer_textures(const Asset& model,
                                                         const UploadPlan& plan);

}  // namespace paim::player
