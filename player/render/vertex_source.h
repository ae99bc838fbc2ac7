// Where positions and radiance of an asset's vertices come from: shaders decode them
// (shader_vertices.h), or the CPU does (cpu_vertices.h).
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "paim/codec/asset.h"
#include "paim/light/light.h"
#include "player/render/surface_mesh.h"

namespace paim::player {

class VertexSource {
  public:
    virtual ~VertexSource() = default;

    // Writes positions and radiance into the attributes of the parts, as far as they differ from those
    // of the last call: nothing if all arguments are the same, colours alone if only the light is new, and
    // of parts that stand still nothing that only the time has changed.
    // time   in poses, clamped to 0 … P−1; fractions lie between poses
    // light  of the scene, bands that it does not have are dark; nullptr leaves colours and gloss as
    //        they are
    // gloss  whether gloss is shown; if not, it is left as it is
    // parts  one for each part of the asset, the same at every call
    void update(double time, const DecodeLimits& limits, const LightCoefficients* light, bool gloss,
                std::span<SurfaceMesh> parts);

    // Something else has written colours into the parts.
    void forget_colors();

    // What can be shown at most of the part that moves.
    virtual DecodeLimits most() const = 0;
    virtual bool is_on_cpu() const = 0;
    // Of all textures that it made.
    virtual uint64_t texture_bytes() const = 0;

  protected:
    explicit VertexSource(const Asset& asset);

    // What has changed of a part.
    struct Changes {
        bool positions, colors;
        bool gloss;  // its outgoing coefficients
    };
    // changes  of each part
    // light    there where colours or gloss of a part have changed
    virtual void write(double time, const DecodeLimits& limits, const LightCoefficients* light,
                       std::span<const Changes> changes, std::span<SurfaceMesh> parts) = 0;

  private:
    std::vector<bool> stands_still_, is_glossy_;  // [parts]
    // What the attributes of a part are of.
    struct Pose {
        double time;
        uint32_t num_components;
        bool operator==(const Pose&) const = default;
    };
    struct LitPose {
        double time;
        DecodeLimits limits;
        std::vector<Vec3f> light;
        bool operator==(const LitPose&) const = default;
    };
    struct Written {
        std::optional<Pose> pose;
        std::optional<LitPose> lit, gloss;
    };
    std::vector<Written> written_;  // [parts]
};

enum class Decoder {
    automatic,  // shaders on a GPU that can hold the asset, otherwise the CPU
    gpu,
    cpu,
};

// Decodes within the limits, or, if shaders of this driver can hold only so much, within `fewer`.
// note  set to why the CPU decodes although shaders were to be tried first
// Errors (unsupported) of Decoder::gpu: the asset does not fit into this driver's textures, or this player
// has no shader for its codec.
std::unique_ptr<VertexSource> make_vertex_source(const std::shared_ptr<const Asset>& asset,
                                                 const DecodeLimits& limits,
                                                 const DecodeLimits& fewer, Decoder decoder,
                                                 std::string& note);

}  // namespace paim::player
