// Transfer in textures, of any codec that the player draws, and the light that it meets.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>

#include "paim/codec/asset.h"
#include "paim/codec/decode_limits.h"
#include "paim/light/light.h"
#include "player/gl/program.h"
#include "player/render/codec_words.h"
#include "player/render/upload_plan.h"

namespace paim::player {

class TransferTextures {
  public:
    virtual ~TransferTextures() = default;

    // GLSL that reads these textures and defines shade(v), the radiance of a vertex before its albedo
    // (shaders/radiance.vert), and the #define lines before it.
    virtual std::string_view shader() const = 0;
    virtual std::string defines() const = 0;
    virtual uint64_t size_bytes() const = 0;

    // Uploads everything that changes with time and light, hands textures and counts to the
    // program, which is in use, and returns the first texture unit that is free after those from
    // `unit`.
    virtual int bind(const gl::Program& program, int unit, double time, const DecodeLimits& limits,
                     const LightCoefficients& light) = 0;
};

// How a codec's transfer gets into textures.
struct TransferUploader {
    std::string_view codec;
    // Texels of the largest texture. Throws Error(unsupported) if the driver's cannot hold that
    // many.
    int64_t (*largest_texture)(const CodedMesh& mesh, const UploadPlan& plan, int max_texture_size);
    // Uploads the transfer as planned. Keeps a reference to the mesh for everything that changes.
    std::unique_ptr<TransferTextures> (*upload)(const CodedMesh& mesh, const UploadPlan& plan);
    // If vertices have components of their own.
    std::optional<CodecWords> words = {};
};

// Of the mesh's codec. Error (unsupported) if this player does not draw it. transfer_textures.cpp
// is the one place that names codecs.
const TransferUploader& find_uploader(const CodedMesh& mesh);

}  // namespace paim::player
