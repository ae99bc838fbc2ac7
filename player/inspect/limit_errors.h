// What the limits of decoding lose at every vertex: a pose within the limits against the same pose of
// the whole file.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "paim/codec/asset.h"
#include "paim/codec/decode_limits.h"
#include "paim/codec/playback.h"
#include "paim/codec/rebuild_planes.h"
#include "paim/codec/transfer_player.h"
#include "paim/mesh/bounds.h"

namespace paim::player {

enum class ErrorOf {
    // Norm of the difference over all coefficients and channels, as a fraction of the RMS norm of the
    // transfer of a vertex. Bands beyond the limits are zero.
    transfer,
    // Norm of the difference of RGB under the light, as a fraction of the RMS norm of radiance.
    radiance,
    // Distance, as a fraction of the diagonal of the bounds of the first part in this pose, without a
    // floor that does not follow it and without outliers.
    position,
};

// RMS norms and the diagonal are those of the whole file at the same time; RMS is over the vertices
// of all parts that a face has. A fraction of zero is infinite, or 0 if the error is 0, too. The
// object keeps its memory from call to call, and the pose of the whole file while only the limits
// change.
class LimitErrors {
  public:
    // asset  with at least one part (checked)
    explicit LimitErrors(std::shared_ptr<const Asset> asset);

    const Asset& asset() const { return *asset_; }
    // Vertices of a part that a face has, ascending: the others are in no mean and no maximum.
    std::span<const uint32_t> counted(size_t part) const { return parts_[part].counted; }

    void set_light(const LightField& light);
    bool has_light() const { return has_light_; }

    // Errors at `time` in poses, clamped to 0 … P−1. Radiance needs a light (checked).
    // returns  [parts] of [V], valid until the next call
    const std::vector<std::vector<float>>& measure(ErrorOf what, double time,
                                                   const DecodeLimits& limits);

    // The surface within the limits under the light, which must have been set (checked). Valid until
    // the next call.
    const Playback& play(double time, const DecodeLimits& limits);

  private:
    struct Part {
        explicit Part(const CodedMesh& coded);

        const CodedMesh& mesh;
        std::vector<uint32_t> counted;
        std::unique_ptr<TransferPlayer> player;
        PositionDecoder decoder;
        std::optional<double> whole_time;  // of `whole`
        TransferLayout layout, whole_layout;
        std::vector<float> limited, whole;  // [planes][V] transfer
        std::vector<float> limited_positions, whole_positions;
        std::vector<double> norms;  // [V] squared, of the whole file
    };

    void measure_transfer(double time, const DecodeLimits& limits);
    void measure_radiance(double time, const DecodeLimits& limits);
    void measure_positions(double time, const DecodeLimits& limits);
    double root_mean_square() const;
    void divide_by(double reference);

    std::shared_ptr<const Asset> asset_;
    std::vector<Part> parts_;
    Playback limited_, whole_;
    bool has_light_ = false;
    std::vector<std::vector<float>> errors_;
};

// Bounds of the body of a part, without the vertices that do not follow its root motion unless it
// has no others, of vertices that a face has.
// positions  [3][V] local coordinates
// counted    vertices that a face has, ascending
Bounds body_bounds(const CodedMesh& mesh, std::span<const float> positions,
                   std::span<const uint32_t> counted);

// Whether the limits show all that the asset has.
bool show_all(const Asset& asset, const DecodeLimits& limits);

}  // namespace paim::player
