// Paints views: numbers first, where a view has them, then their colours.
#include "player/inspect/surface_colors.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <span>
#include <utility>

#include "paim/base/check.h"
#include "paim/base/message.h"
#include "paim/base/parallel.h"
#include "paim/codec/point_groups.h"
#include "paim/sh/index.h"
#include "player/inspect/false_color.h"
#include "player/inspect/sample_times.h"

namespace paim::player {

namespace {

constexpr size_t kColorsAtOnce = 8192;

// √(4π): an unoccluded vertex has the zeroth coefficient λ_0 y_00 = 1 / √(4π), with λ_0 = 1
// (paim/sh/cosine_lobe.h) and y_00 = 1 / √(4π), whatever its normal is.
const float kPerOpenVertex = static_cast<float>(std::sqrt(4.0 * kPi));

// colors[v] = color_of(v), on all threads.
template <typename ColorOf>
void fill_colors(std::vector<Vec3f>& colors, size_t num_vertices, const ColorOf& color_of) {
    colors.resize(num_vertices);
    parallel_for(num_vertices, kColorsAtOnce, [&](size_t first, size_t end) {
        for (size_t v = first; v < end; ++v) colors[v] = color_of(v);
    });
}

Vec3f soft_light(const Vec3f& normal, const Vec3f& to_light) {
    constexpr float kAmbient = 0.08f, kDiffuse = 0.62f;
    // Half Lambert: the dark side has shape, too. (Mitchell, McTaggart and Green, Shading in Valve's
    // Source Engine, 2006)
    const float half = 0.5f + 0.5f * normal.dot(to_light);
    return Vec3f::Constant(kAmbient + kDiffuse * half * half);
}

}  // namespace

ErrorOf error_of(SurfaceView view) {
    PAIM_CHECK(is_error_view(view));
    if (view == SurfaceView::transfer_error) return ErrorOf::transfer;
    return view == SurfaceView::radiance_error ? ErrorOf::radiance : ErrorOf::position;
}

SurfaceColors::SurfaceColors(std::shared_ptr<const Asset> asset)
    : asset_(std::move(asset)), errors_(asset_), parts_(asset_->parts.size()) {
    surface_.colors.resize(parts_.size());
    surface_.values.resize(parts_.size());
}

const ColoredSurface& SurfaceColors::paint(const SurfaceQuery& query) {
    PAIM_CHECK_LT(query.coefficient, uint32_t{sh::num_coefficients(sh::kMaxBands)});
    surface_.legend = {};
    surface_.legend.title = legend_title(query.view, query.coefficient, query.channel);
    surface_.legend.kind = scale_of(query.view);
    if (surface_.legend.kind == ScaleKind::none) {
        for (std::vector<float>& values : surface_.values) values.clear();
        paint_colors(query);
        return surface_;
    }
    measure(query);
    paint_values(query);
    if (is_error_view(query.view)) describe_errors(query);
    if (query.view == SurfaceView::open_fraction) describe_open_fraction();
    return surface_;
}

float SurfaceColors::sequence_scale(SurfaceQuery query) {
    if (scale_of(query.view) == ScaleKind::none) return 0.0f;
    constexpr uint32_t kMostPoses = 16;
    float scale = 0.0f;
    for (const double time : sample_times(asset_->num_poses(), kMostPoses)) {
        query.time = time;
        measure(query);
        scale = std::max(scale, largest());
    }
    return scale;
}

// Sets the values of all parts.
void SurfaceColors::measure(const SurfaceQuery& query) {
    if (query.view == SurfaceView::coefficient) {
        measure_transfer_plane(query, query.coefficient, 1.0f);
    } else if (query.view == SurfaceView::open_fraction) {
        measure_transfer_plane(query, 0, kPerOpenVertex);
    } else {
        surface_.values = errors_.measure(error_of(query.view), query.time, query.limits);
    }
}

// One coefficient of the transfer within the limits, times the factor; zero beyond the bands.
void SurfaceColors::measure_transfer_plane(const SurfaceQuery& query, uint32_t coefficient,
                                           float factor) {
    const auto band = static_cast<uint32_t>(sh::band_of(static_cast<int>(coefficient)));
    // Later bands need not be decoded.
    DecodeLimits limits = query.limits;
    limits.bands = std::min(limits.bands, band + 1);
    for (size_t number = 0; number < parts_.size(); ++number) {
        const CodedMesh& mesh = asset_->parts[number];
        std::vector<float>& values = surface_.values[number];
        values.assign(mesh.topology.num_vertices, 0.0f);
        if (band >= mesh.layout.with_bands(limits.bands).in_bands) {
            surface_.legend.note = message("Band {} is not within the limits.", band);
            continue;
        }
        Part& part = parts_[number];
        if (part.player == nullptr) part.player = mesh.transfer->make_player(mesh.layout);
        part.player->decode(query.time, limits, layout_, transfer_);
        const std::array<float, 3> weights = channel_weights(layout_, query.channel);
        parallel_for(values.size(), kColorsAtOnce, [&](size_t first, size_t end) {
            for (uint32_t channel = 0; channel < layout_.channels; ++channel) {
                const float* const plane =
                    transfer_.data() + layout_.plane(channel, coefficient) * values.size();
                const float weight = factor * weights[channel];
                for (size_t v = first; v < end; ++v) values[v] += weight * plane[v];
            }
        });
    }
}

// The largest magnitude of a value, over vertices that a face has.
float SurfaceColors::largest() const {
    float largest = 0.0f;
    for (size_t part = 0; part < parts_.size(); ++part) {
        for (const uint32_t v : errors_.counted(part)) {
            largest = std::max(largest, std::abs(surface_.values[part][v]));
        }
    }
    return largest;
}

void SurfaceColors::paint_values(const SurfaceQuery& query) {
    Legend& legend = surface_.legend;
    const bool is_signed = legend.kind == ScaleKind::signed_values;
    const bool is_share = query.view == SurfaceView::open_fraction;
    legend.highest = query.scale.value_or(is_share ? 1.0f : largest());
    legend.lowest = is_signed ? -legend.highest : 0.0f;
    for (size_t part = 0; part < parts_.size(); ++part) {
        const std::vector<float>& values = surface_.values[part];
        fill_colors(surface_.colors[part], values.size(), [&](size_t v) {
            if (is_signed) return signed_color(values[v], legend.highest);
            return heat_color(legend.highest > 0.0f ? values[v] / legend.highest : 0.0f);
        });
    }
}

void SurfaceColors::paint_colors(const SurfaceQuery& query) {
    if (query.view == SurfaceView::groups) return paint_groups();
    if (query.view == SurfaceView::normals || query.view == SurfaceView::shape) {
        return paint_normals(query);
    }
    if (query.view == SurfaceView::lit) {
        const Playback& playback = errors_.play(query.time, query.limits);
        for (size_t part = 0; part < parts_.size(); ++part) {
            const std::span radiance = playback.radiance(part);
            surface_.colors[part].assign(radiance.begin(), radiance.end());
        }
        return;
    }
    for (size_t part = 0; part < parts_.size(); ++part) {
        const CodedMesh& mesh = asset_->parts[part];
        fill_colors(surface_.colors[part], mesh.topology.num_vertices,
                    [&](size_t v) { return mesh.albedo.at(static_cast<uint32_t>(v)); });
    }
}

void SurfaceColors::paint_normals(const SurfaceQuery& query) {
    const Vec3f to_light = query.headlight.normalized();
    for (size_t number = 0; number < parts_.size(); ++number) {
        Part& part = parts_[number];
        if (!part.normals) part.normals.emplace(asset_->parts[number]);
        const auto normals = part.normals->at(query.time, query.limits.geometry_components);
        fill_colors(surface_.colors[number], normals.size(), [&](size_t v) -> Vec3f {
            if (query.view == SurfaceView::shape) return soft_light(normals[v], to_light);
            return Vec3f::Constant(0.5f) + 0.5f * normals[v];
        });
    }
}

void SurfaceColors::paint_groups() {
    for (size_t number = 0; number < parts_.size(); ++number) {
        Part& part = parts_[number];
        const CodedMesh& mesh = asset_->parts[number];
        if (!part.groups) {
            const std::optional<PointGroups> groups = mesh.transfer->point_groups();
            part.groups = groups ? groups->group : std::vector<uint32_t>();
        }
        const std::vector<uint32_t>& groups = *part.groups;
        fill_colors(surface_.colors[number], mesh.topology.num_vertices,
                    [&](size_t v) { return category_color(groups.empty() ? 0 : groups[v]); });
        if (!groups.empty() || !surface_.legend.note.empty()) continue;
        surface_.legend.note = number == 0
                                   ? "Every vertex has values of its own: there are no groups."
                                   : "Every vertex of the still part has values of its own.";
    }
}

void SurfaceColors::describe_errors(const SurfaceQuery& query) {
    Legend::Worst worst;
    double sum = 0.0;
    size_t count = 0;
    for (size_t part = 0; part < parts_.size(); ++part) {
        for (const uint32_t v : errors_.counted(part)) {
            const float value = surface_.values[part][v];
            sum += double{value};
            if (count++ > 0 && !(value > worst.value)) continue;
            worst = {static_cast<uint32_t>(part), v, value};
        }
    }
    if (count == 0) return;
    Legend& legend = surface_.legend;
    legend.worst = worst;
    legend.mean_error = sum / static_cast<double>(count);
    if (worst.value != 0.0f) return;
    legend.note = show_all(*asset_, query.limits)
                      ? "The limits show all that the file has: every error is zero."
                      : "What the limits leave out changes nothing here in this pose.";
}

void SurfaceColors::describe_open_fraction() {
    size_t num_above = 0;
    for (size_t part = 0; part < parts_.size(); ++part) {
        for (const uint32_t v : errors_.counted(part)) {
            // More than what dropped components, noise and rounding may add to an open vertex.
            num_above += surface_.values[part][v] > 1.05f ? 1 : 0;
        }
    }
    if (num_above == 0) return;
    surface_.legend.note = message(
        "Vertices above 1.05, where light that bounces adds to the open sky: {}.", num_above);
}

}  // namespace paim::player
