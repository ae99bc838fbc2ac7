// One part of a bake.
#include "paim/format/bake/baked_part.h"

#include <algorithm>
#include <span>

#include "paim/base/check.h"
#include "paim/mesh/face_vertices.h"

namespace paim {

namespace {

void copy_rows(std::span<const float> rows, uint64_t first, uint64_t count, float* out) {
    PAIM_CHECK(first <= rows.size() && count <= rows.size() - first);
    std::copy_n(rows.begin() + static_cast<ptrdiff_t>(first), count, out);
}

}  // namespace

BakedPart::BakedPart(const BakeReader& bake, size_t number)
    : bake_(bake), still_(number == 0 ? nullptr : &bake.still_mesh().value()) {
    PAIM_CHECK_LT(number, num_baked_parts(bake));
}

const Topology& BakedPart::topology() const {
    return still_ == nullptr ? bake_.topology() : still_->topology;
}

const Albedo& BakedPart::albedo() const {
    return still_ == nullptr ? bake_.albedo() : still_->albedo;
}

const Texture& BakedPart::texture() const {
    return still_ == nullptr ? bake_.texture() : still_->texture;
}

const RootMotion& BakedPart::root_motion() const {
    static const RootMotion none;
    return still_ == nullptr ? bake_.identity().root_motion : none;
}

uint32_t BakedPart::num_following() const {
    return still_ == nullptr ? bake_.identity().num_following : kAllVertices;
}

void BakedPart::read_position_rows(uint32_t p, uint64_t first, uint64_t count, float* out) const {
    if (still_ == nullptr) return bake_.read_position_rows(p, first, count, out);
    copy_rows(still_->pose.positions, first, count, out);
}

void BakedPart::read_normal_rows(uint32_t p, uint64_t first, uint64_t count, float* out) const {
    if (still_ == nullptr) return bake_.read_normal_rows(p, first, count, out);
    copy_rows(still_->pose.normals, first, count, out);
}

void BakedPart::read_transfer_rows(uint32_t p, uint64_t first, uint64_t count, float* out) const {
    if (still_ == nullptr) return bake_.read_transfer_rows(p, first, count, out);
    copy_rows(still_->pose.transfer, first, count, out);
}

void BakedPart::read_noise_rows(uint32_t p, uint64_t first, uint64_t count, float* out) const {
    if (still_ == nullptr) return bake_.read_noise_rows(p, first, count, out);
    copy_rows(still_->pose.noise, first, count, out);
}

PositionOutliers find_outliers(const BakedPart& part) {
    return find_outliers(part.num_vertices(), part.num_poses(), face_vertices(part.topology()),
                         [&](uint32_t p, uint64_t first, uint64_t count, float* rows) {
                             part.read_position_rows(p, first, count, rows);
                         });
}

}  // namespace paim
