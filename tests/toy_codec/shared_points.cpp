// A third codec, made for the tests in this folder.
#include "tests/toy_codec/shared_points.h"

#include <algorithm>
#include <cmath>

#include "paim/codec/frame_cost.h"
#include "paim/codec/point_groups.h"
#include "paim/codec/transfer_player.h"

namespace paim::toy {

std::unique_ptr<TransferModel> SharedPoints::clone() const {
    return std::make_unique<SharedPoints>(*this);
}

void SharedPoints::vertices_from_points(std::span<const float> points, uint32_t /*none*/,
                                        std::span<float> out) const {
    const size_t num_planes = out.size() / owner.size();
    for (size_t plane = 0; plane < num_planes; ++plane) {
        for (size_t v = 0; v < owner.size(); ++v) {
            out[plane * owner.size() + v] = gain[v] * points[plane * num_shared + owner[v]];
        }
    }
}

FrameCost SharedPoints::cost(const TransferLayout& layout, const DecodeLimits& limits,
                             bool coloured_light) const {
    const TransferLayout used = layout.with_bands(limits.bands);
    const uint64_t num_components = std::min(limits.transfer_components, matrix.num_components);
    return {used.num_planes(),
            uint64_t{num_radiance_channels(layout, coloured_light)} * used.num_coefficients(),
            (num_components + 1) * used.num_planes() * num_shared};
}

double SharedPoints::vertex_gain() const {
    double largest = 0.0;
    for (const float g : gain) largest = std::max(largest, std::abs(double{g}));
    return largest;
}

std::optional<PointGroups> SharedPoints::point_groups() const {
    return PointGroups{
        num_shared, owner,
        Eigen::Map<const Eigen::VectorXf>(gain.data(), static_cast<Eigen::Index>(gain.size()))};
}

std::vector<NamedNumber> SharedPoints::numbers() {
    return {{"shared_points", &num_shared, 1, 1000, nullptr}};
}

uint32_t SharedPoints::start(uint32_t num_vertices) {
    num_stored_vertices_ = num_vertices;
    return num_shared;
}

std::vector<SectionRow> SharedPoints::sections() {
    const uint32_t count = owner.empty() ? num_stored_vertices_ : num_vertices();
    return {{"TOWN", 0, 1, count, true, SmallNumbers{&owner, num_shared}},
            {"TGAN", 0, 1, count, false, &gain}};
}

TransferCodec codec() {
    return {SharedPoints::kName,
            []() -> std::unique_ptr<TransferModel> { return std::make_unique<SharedPoints>(); }};
}

}  // namespace paim::toy
