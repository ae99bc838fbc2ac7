// Code that codecs share: rebuilding points, computing vertices from them, and lighting these.
#include "paim/codec/transfer_model.h"

#include <algorithm>
#include <optional>

#include "paim/codec/frame_cost.h"
#include "paim/codec/point_groups.h"
#include "paim/codec/rebuild_planes.h"
#include "paim/codec/section_row.h"
#include "paim/codec/transfer_player.h"
#include "paim/shade/shade.h"

namespace paim {

namespace {

// Decodes the transfer of all vertices, then lights it.
class DecodingPlayer : public TransferPlayer {
  public:
    DecodingPlayer(const TransferModel& model, const TransferLayout& layout)
        : model_(model), layout_(layout) {}

    void decode(double time, const DecodeLimits& limits, TransferLayout& layout,
                std::vector<float>& transfer) override {
        if (model_.points_are_vertices()) {
            points_.decode(model_.matrix, layout_, time, limits, layout, transfer);
            return;
        }
        points_.decode(model_.matrix, layout_, time, limits, layout, values_);
        transfer.resize(size_t{layout.num_planes()} * model_.num_vertices());
        model_.vertices_from_points(
            values_, std::min(limits.vertex_components, model_.num_vertex_components()), transfer);
    }

    void light(double time, const DecodeLimits& limits, const LightCoefficients& light,
               const Albedo& albedo, std::vector<Vec3f>& radiance) override {
        if (time_ != time || limits_ != limits) {
            decode(time, limits, lit_layout_, transfer_);
            time_ = time;
            limits_ = limits;
        }
        shade(lit_layout_, transfer_, albedo, light, radiance);
    }

  private:
    const TransferModel& model_;
    const TransferLayout layout_;
    PointDecoder points_;
    std::vector<float> values_;   // [planes][N]
    std::optional<double> time_;  // of transfer_
    DecodeLimits limits_;
    TransferLayout lit_layout_;
    std::vector<float> transfer_;  // [planes][V]
};

}  // namespace

std::optional<PointGroups> TransferModel::point_groups() const {
    return {};
}

TransferModel::~TransferModel() = default;

void TransferModel::vertices_from_points(std::span<const float> points, uint32_t,
                                         std::span<float> out) const {
    PAIM_CHECK(points_are_vertices());
    PAIM_CHECK_EQ(points.size(), out.size());
    std::copy(points.begin(), points.end(), out.begin());
}

std::unique_ptr<TransferPlayer> TransferModel::make_player(const TransferLayout& layout) const {
    return std::make_unique<DecodingPlayer>(*this, layout);
}

uint64_t TransferModel::vertex_bytes(uint32_t) const {
    return 0;
}

std::vector<NamedNumber> TransferModel::numbers() {
    return {};
}

std::vector<NamedNumber> TransferModel::numbers() const {
    return const_cast<TransferModel*>(this)->numbers();
}

std::vector<SectionRow> TransferModel::sections() {
    return {};
}

}  // namespace paim
