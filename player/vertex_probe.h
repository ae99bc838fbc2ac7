// One vertex: which one a place of the picture shows, where it is, what light it takes, and how its error
// changes over time.
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "paim/codec/asset.h"
#include "paim/codec/mesh_decoder.h"
#include "paim/light/light.h"
#include "player/inspect/vertex_history.h"
#include "player/view/view_state.h"

namespace paim::player {

class VertexProbe {
  public:
    explicit VertexProbe(std::shared_ptr<const Asset> asset) : asset_(std::move(asset)) {}

    // The nearest vertex of what is seen in this place of a picture; nothing if there is none.
    // x, y  0 … 1 from the upper left corner
    std::optional<PickedVertex> pick(double time, const DecodeLimits& limits, const Camera& camera,
                                     float x, float y, float aspect);

    // Where a vertex is in the scene. No other vertex is decoded.
    Vec3f position(double time, const DecodeLimits& limits, const PickedVertex& vertex) const;

    // Its transfer, luminance, by coefficient, in the axes of the scene. Decodes all of the part if time
    // or limits differ from the last call's.
    // returns  [bands²] within the limits
    std::vector<float> transfer(double time, const DecodeLimits& limits,
                                const PickedVertex& vertex);

  private:
    std::shared_ptr<const Asset> asset_;
    // The part that was decoded last.
    struct Decoded {
        size_t part;
        double time;
        DecodeLimits limits;
        bool operator==(const Decoded&) const = default;
    };
    std::optional<Decoded> decoded_;
    DecodedPose pose_;
};

// The error of a vertex at every pose, under one light. It has its own decoders, and shares the asset.
class ErrorHistory {
  public:
    // surface  a view of errors
    ErrorHistory(std::shared_ptr<const Asset> asset, const PickedVertex& vertex,
                 SurfaceView surface, const DecodeLimits& limits, const LightCoefficients& light);
    ErrorHistory(const ErrorHistory&) = delete;
    ErrorHistory& operator=(const ErrorHistory&) = delete;

    // Whether it is the history of this; the light counts for that only when a history starts.
    bool is_of(const std::shared_ptr<const Asset>& asset, const PickedVertex& vertex,
               SurfaceView surface, const DecodeLimits& limits) const;

    SurfaceView surface() const { return surface_; }
    VertexHistory& values() { return values_; }
    const VertexHistory& values() const { return values_; }

  private:
    std::shared_ptr<const Asset> asset_;
    PickedVertex vertex_;
    SurfaceView surface_;
    DecodeLimits limits_;
    LimitErrors errors_;
    VertexHistory values_;
};

}  // namespace paim::player
