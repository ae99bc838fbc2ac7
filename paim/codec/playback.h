// Plays an asset on the CPU: a light and a time in, positions and radiance out.
#pragma once

#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "paim/codec/asset.h"
#include "paim/codec/decode_limits.h"
#include "paim/codec/rebuild_planes.h"
#include "paim/codec/transfer_player.h"
#include "paim/light/light.h"

namespace paim {

// Owns its scratch memory: one a thread; any number may share an asset. update() does only what is
// needed: nothing if neither time, limits nor light changed; the light alone if the pose is the same.
class Playback {
  public:
    // asset  with at least one part (checked), as read_paim() returns it
    explicit Playback(std::shared_ptr<const Asset> asset);

    const Asset& asset() const { return *asset_; }
    size_t num_parts() const { return parts_.size(); }

    // Lights all parts from the next update() on. The field is asked at the centre of each part's mean
    // positions, for as many bands as the part has; it is not kept.
    void set_light(const LightField& light);

    // Rebuilds what is shown at `time` in poses: 0 … P−1, clamped; fractions lie between two poses.
    void update(double time, const DecodeLimits& limits = {});

    // Results of the last update(), valid until the next one.
    // returns  [3][V]: all x, then all y, then all z, scene units
    std::span<const float> positions(size_t part = 0) const;
    // returns  [V] linear RGB; empty if no light was set
    std::span<const Vec3f> radiance(size_t part = 0) const;

  private:
    struct Part {
        explicit Part(const CodedMesh& coded);

        const CodedMesh& mesh;
        Vec3f centre;
        PositionDecoder decoder;
        std::unique_ptr<TransferPlayer> player;
        LightCoefficients light;
        bool is_lit = false;  // radiance is that of the light
        std::optional<double> time;
        DecodeLimits limits;
        std::vector<float> positions;
        std::vector<Vec3f> radiance;
    };
    static void update(Part& part, double time, const DecodeLimits& limits);

    std::shared_ptr<const Asset> asset_;
    std::vector<Part> parts_;
};

}  // namespace paim
