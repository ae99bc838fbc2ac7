// Error curve over the components of a vertex of a file.
#include "analysis/setting_curves/vertex_component_curve.h"

#include <fmt/format.h>

#include <limits>

#include "analysis/file_poses.h"
#include "analysis/setting_curves/measure_settings.h"
#include "analysis/setting_curves/vertex_component_theory.h"
#include "analysis/stable_time.h"
#include "paim/base/error.h"
#include "paim/codec/frame_cost.h"
#include "paim/codec/section_row.h"
#include "paim/metrics/singular_value_error.h"

namespace paim {

namespace {

DecodeLimits limits_of(uint32_t vertex_components) {
    DecodeLimits limits;
    limits.vertex_components = vertex_components;
    return limits;
}

void add_theory(const VertexComponentSpectrum& spectrum, Setting& setting) {
    constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
    const bool is_known = !spectrum.sum.empty();
    setting.columns.push_back(
        {"theory_error", "fraction", is_known ? theory_error(spectrum.sum, setting.value) : kNone});
    setting.columns.push_back({"energy_error", "fraction",
                               is_known ? energy_error(spectrum.root, setting.value) : kNone});
}

void add_costs(const CodedMesh& mesh, Setting& setting) {
    const DecodeLimits limits = limits_of(setting.value);
    const FrameCost cost = mesh.transfer->cost(mesh.layout, limits, true);
    setting.columns.push_back({"multiply_adds", "per vertex and frame", cost.per_vertex()});
    setting.columns.push_back({"cpu_multiply_adds", "per frame", cost.cpu_per_frame});
    setting.columns.push_back(
        {"vertex_values", "bytes in memory", mesh.transfer->vertex_bytes(setting.value)});
    MeshDecoder decoder(mesh);
    DecodedPose decoded;
    const PoseTime time = time_poses(
        mesh.num_poses(), [&](uint32_t p) { decoder.decode(p, limits, decoded); }, kQuickSeconds);
    setting.columns.push_back({"decode", "ms per pose", time.median_ms});
}

}  // namespace

std::string vertex_component_name(const TransferModel& transfer) {
    for (const NamedNumber& number : transfer.numbers()) {
        if (number.limit == &DecodeLimits::vertex_components && *number.value > 0) {
            return number.name;
        }
    }
    throw_bad_input("its transfer has no components of vertices (codec {})", transfer.codec_name());
}

SettingCurve measure_vertex_components(const Asset& asset, const BakeReader& bake,
                                       const Stage& stage, const Reference& reference,
                                       const std::vector<uint32_t>& wanted,
                                       const std::function<void()>& on_step) {
    const CodedMesh& mesh = asset.moving();
    const TransferModel& transfer = *mesh.transfer;
    SettingCurve curve;
    curve.name = vertex_component_name(transfer);
    curve.title =
        fmt::format("Components of a vertex ({} of codec {})", curve.name, transfer.codec_name());
    curve.explanation =
        "A file with fewer components of each vertex. Positions are those of the bake, so that pictures "
        "show what the transfer loses. Theory is the share of the components' norms that is dropped, "
        "over all groups of vertices that share them; energy is its root-mean-square form.";
    curve.axis = "components of a vertex";
    curve.drawn = {"theory_error", "energy_error", "transfer_error"};
    curve.reference_name = reference.name;
    const uint32_t all = transfer.num_vertex_components();
    const VertexComponentSpectrum spectrum = vertex_component_spectrum(transfer);
    FilePoses poses(asset, bake);
    std::vector<SettingSource> sources;
    for (const uint32_t value : values_up_to(all, wanted)) {
        Setting& setting = curve.settings.emplace_back();
        setting.value = value;
        setting.all = value == all;
        add_theory(spectrum, setting);
        add_costs(mesh, setting);
        sources.push_back({[&poses, value](uint32_t p) { return poses.pose(p, limits_of(value)); },
                           poses.still()});
    }
    measure_settings(curve, sources, stage, compared_with_bake(bake, reference), on_step);
    return curve;
}

}  // namespace paim
