// A third codec, made for the tests in this folder and known to nobody outside it: vertices share
// points and each has a gain of its own.
#pragma once

#include <memory>
#include <vector>

#include "paim/codec/codecs.h"
#include "paim/codec/section_row.h"
#include "paim/codec/transfer_model.h"

namespace paim::toy {

// t(v) = gain[v] · point(owner[v])
class SharedPoints : public TransferModel {
  public:
    static constexpr std::string_view kName = "shared-points";

    SharedPoints() = default;
    SharedPoints(LowRank points, std::vector<uint32_t> owners, std::vector<float> gains)
        : TransferModel(std::move(points)),
          owner(std::move(owners)),
          gain(std::move(gains)),
          num_shared(matrix.num_points) {}

    std::string_view codec_name() const override { return kName; }
    std::unique_ptr<TransferModel> clone() const override;
    uint32_t num_vertices() const override { return static_cast<uint32_t>(owner.size()); }
    void vertices_from_points(std::span<const float> points, uint32_t num_components,
                              std::span<float> out) const override;
    FrameCost cost(const TransferLayout& layout, const DecodeLimits& limits,
                   bool coloured_light) const override;
    double vertex_gain() const override;
    std::optional<PointGroups> point_groups() const override;
    std::vector<NamedNumber> numbers() override;
    uint32_t start(uint32_t num_vertices) override;
    std::vector<SectionRow> sections() override;
    bool always_packed() const override { return true; }

    std::vector<uint32_t> owner;  // [V]
    std::vector<float> gain;      // [V]
    uint32_t num_shared = 0;      // points

  private:
    uint32_t num_stored_vertices_ = 0;  // of a file that is being read
};

TransferCodec codec();

}  // namespace paim::toy
