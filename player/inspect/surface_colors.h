// Colours of every vertex in a view, and what they mean.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "paim/codec/asset.h"
#include "paim/codec/decode_limits.h"
#include "player/inspect/legend.h"
#include "player/inspect/limit_errors.h"
#include "player/inspect/pose_normals.h"
#include "player/inspect/surface_view.h"
#include "player/inspect/transfer_channel.h"

namespace paim::player {

// The error that a view of errors (checked) shows.
ErrorOf error_of(SurfaceView view);

struct SurfaceQuery {
    SurfaceView view = SurfaceView::lit;
    double time = 0.0;  // in poses, clamped to 0 … P−1
    DecodeLimits limits{};
    uint32_t coefficient = 0;  // i = l (l + 1) + m, of the view `coefficient`
    uint32_t channel =
        kLuminance;  // 0 … 2, or kLuminance: of the coefficient and the open fraction
    // The number at the end of the scale. Nothing: the largest one on the surface, and 1 for the open
    // fraction.
    std::optional<float> scale{};
    // From the surface to the soft light of the view `shape`, in the scene; not zero.
    Vec3f headlight{0.35f, 0.6f, 0.72f};
};

struct Legend {
    std::string title;  // with the unit
    ScaleKind kind = ScaleKind::none;
    float lowest = 0.0f, highest = 0.0f;  // at the ends of the scale
    // Of the largest error, over vertices that a face has; the first of equal ones. Error views alone.
    struct Worst {
        uint32_t part = 0, vertex = 0;
        float value = 0.0f;
    };
    std::optional<Worst> worst;
    std::optional<double> mean_error;  // over the same vertices
    std::string note;                  // a sentence, or empty
};

struct ColoredSurface {
    // [parts] of [V] linear RGB, 0 … 1; radiance and albedo are what they are.
    std::vector<std::vector<Vec3f>> colors;
    // [parts] of [V] the numbers behind the colours; of views with a scale alone.
    std::vector<std::vector<float>> values;
    Legend legend;
};

// It keeps its memory from call to call: two decoded poses of the transfer while errors are shown.
class SurfaceColors {
  public:
    // asset  with at least one part (checked)
    explicit SurfaceColors(std::shared_ptr<const Asset> asset);

    // The light of the views `lit` and `radiance_error`.
    void set_light(const LightField& light) { errors_.set_light(light); }
    LimitErrors& errors() { return errors_; }

    // Colours of all parts, valid until the next call. Views of light need one (checked). Errors are
    // those of LimitErrors.
    const ColoredSurface& paint(const SurfaceQuery& query);

    // The number for `scale` that fits the whole sequence: the largest of at most 16 poses, evenly
    // spaced from the first to the last. 0 for views without a scale. Time and scale of the query do not
    // count. It takes as long as painting 16 times.
    float sequence_scale(SurfaceQuery query);

  private:
    void measure(const SurfaceQuery& query);
    void measure_transfer_plane(const SurfaceQuery& query, uint32_t coefficient, float factor);
    void paint_values(const SurfaceQuery& query);
    void paint_colors(const SurfaceQuery& query);
    void paint_normals(const SurfaceQuery& query);
    void paint_groups();
    float largest() const;
    void describe_errors(const SurfaceQuery& query);
    void describe_open_fraction();

    // Made when the view that needs it is first asked for.
    struct Part {
        std::unique_ptr<TransferPlayer> player;
        std::optional<PoseNormals> normals;
        std::optional<std::vector<uint32_t>> groups;  // [V], or empty: the codec has none
    };

    std::shared_ptr<const Asset> asset_;
    LimitErrors errors_;
    std::vector<Part> parts_;
    TransferLayout layout_;        // of transfer_
    std::vector<float> transfer_;  // of the part that was decoded last
    ColoredSurface surface_;
};

}  // namespace paim::player
