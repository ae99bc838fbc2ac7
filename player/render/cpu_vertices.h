// Decodes and lights vertices on the CPU, and uploads them as attributes.
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "paim/codec/playback.h"
#include "player/render/vertex_source.h"

namespace paim::player {

class CpuVertices : public VertexSource {
  public:
    CpuVertices(std::shared_ptr<const Asset> asset, const DecodeLimits& limits);

    DecodeLimits most() const override { return most_; }
    bool is_on_cpu() const override { return true; }
    uint64_t texture_bytes() const override { return 0; }

  private:
    void write(double time, const DecodeLimits& limits, const LightCoefficients* light,
               std::span<const Changes> changes, std::span<SurfaceMesh> parts) override;

    Playback playback_;
    std::optional<std::vector<Vec3f>> light_;  // that the playback has
    DecodeLimits most_;
};

}  // namespace paim::player
