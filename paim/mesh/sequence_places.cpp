// Vertices that lie at the same places in all poses of a sequence, but for outliers.
#include "paim/mesh/sequence_places.h"

#include <algorithm>
#include <numeric>
#include <unordered_map>
#include <utility>

#include "paim/base/check.h"
#include "paim/mesh/outliers.h"
#include "paim/mesh/places.h"
#include "paim/mesh/sets.h"

namespace paim {

namespace {

// [V] Every vertex at a place of its own.
std::vector<uint32_t> own_places(size_t num_vertices) {
    std::vector<uint32_t> places(num_vertices);
    std::iota(places.begin(), places.end(), 0u);
    return places;
}

uint32_t place_of_vertex(const std::vector<uint32_t>& places, uint32_t v) {
    return places.empty() ? v : places[v];
}

}  // namespace

std::vector<uint32_t> reference_poses(uint32_t num_poses) {
    if (num_poses < 3) return {0};
    const uint64_t n = num_poses;
    return {0, static_cast<uint32_t>(n / 3), static_cast<uint32_t>(2 * n / 3)};
}

SequencePlaces::SequencePlaces(uint32_t num_poses, std::span<const Reference> references)
    : most_outliers_(most_outliers_of_vertex(num_poses)) {
    PAIM_CHECK_EQ(references.size(), reference_poses(num_poses).size());
    std::vector<std::vector<uint32_t>> places;
    for (const Reference& pose : references) places.push_back(first_at_position(pose.positions));
    if (references.size() > 1) {
        std::vector<double> sizes;
        for (const Reference& pose : references) sizes.push_back(pose.bounds.bounds.diagonal());
        std::nth_element(sizes.begin(), sizes.begin() + 1, sizes.end());
        size_ = sizes[1];
        find_homes(references, places);
        // Outliers of several places may lie at one.
        for (size_t r = 0; r < places.size() && !homes_.empty(); ++r) {
            places[r] = first_at_position(references[r].positions, homes_);
        }
    }
    if (size_ > 0.0 && !references[0].bounds.middle.empty()) {
        longest_edge_ = limit(references[0].bounds);
    }
    for (size_t r = 0; r < references.size(); ++r) {
        const Reference& pose = references[r];
        std::vector<uint32_t> lenient = with_outliers(pose.positions, pose.bounds, places[r]);
        if (r == 0 && lenient != places[0]) first_places_ = lenient;
        exact_ = r == 0 ? places[0] : shared_places(exact_, places[r]);
        places_ = r == 0 ? std::move(lenient) : shared_places(places_, lenient);
    }
    base_ = places_;
    if (!homes_.empty() && !base_.empty()) homes_ = base_;
}

// places  [references] where vertices lie in each
void SequencePlaces::find_homes(std::span<const Reference> references,
                                std::span<const std::vector<uint32_t>> places) {
    if (std::all_of(places.begin(), places.end(), [](const auto& p) { return p.empty(); })) return;
    const auto may_share = [&](uint32_t v, uint32_t other) {
        return std::all_of(references.begin(), references.end(), [&](const Reference& pose) {
            const double distance = (pose.positions[v] - pose.positions[other]).norm();
            return distance == 0.0 || distance > limit(pose.bounds);
        });
    };
    const size_t num_vertices = references[0].positions.size();
    Sets homes(num_vertices);
    for (uint32_t v = 0; v < num_vertices; ++v) {
        for (const std::vector<uint32_t>& in_pose : places) {
            const uint32_t other = place_of_vertex(in_pose, v);
            if (other != v && may_share(v, other)) homes.join(v, other);
        }
    }
    homes_.resize(num_vertices);
    for (uint32_t v = 0; v < num_vertices; ++v) homes_[v] = homes.lowest(v);
}

double SequencePlaces::limit(const UsualBounds& bounds) const {
    return std::max(size_, bounds.middle.diagonal());
}

// The places of this pose, with outliers at those of their homes. All vertices at the place of an
// outlier move there with it.
// places  [V] where vertices lie, or empty
std::vector<uint32_t> SequencePlaces::with_outliers(std::span<const Vec3d> positions,
                                                    const UsualBounds& bounds,
                                                    const std::vector<uint32_t>& places) {
    if (homes_.empty() || !(size_ > 0.0)) return places;
    const double farthest = limit(bounds);
    std::unordered_map<uint32_t, uint32_t> moved;  // from place to place
    const auto move = [&](uint32_t from, uint32_t to) {
        const auto [known, is_new] = moved.try_emplace(from, to);
        if (!is_new) known->second = std::min(known->second, to);
    };
    for (uint32_t v = 0; v < homes_.size(); ++v) {
        const uint32_t home = homes_[v];
        if (home == v) continue;
        if (!((positions[v] - positions[home]).norm() > farthest)) continue;
        const bool is_home =
            (positions[home] - bounds.median).norm() > (positions[v] - bounds.median).norm();
        const uint32_t of_v = place_of_vertex(places, v), of_home = place_of_vertex(places, home);
        move(is_home ? of_home : of_v, is_home ? of_v : of_home);
    }
    if (moved.empty()) return places;
    std::vector<uint32_t> result = places.empty() ? own_places(positions.size()) : places;
    const std::lock_guard lock(mutex_);
    num_outliers_.resize(positions.size(), 0);
    for (uint32_t v = 0; v < result.size(); ++v) {
        // Two steps at most: to its home, and from there to a vertex that is no outlier.
        const uint32_t place = result[v];
        for (auto to = moved.find(place); to != moved.end(); to = moved.find(to->second)) {
            result[v] = to->second;
        }
        if (result[v] != place) ++num_outliers_[v];
    }
    return result;
}

void SequencePlaces::add(std::span<const Vec3d> positions, const UsualBounds& bounds) {
    if (base_.empty()) return;
    const std::vector<uint32_t> exact = first_at_position(positions, base_);
    if (exact == base_) return;
    const std::vector<uint32_t> lenient = with_outliers(positions, bounds, exact);
    const std::lock_guard lock(mutex_);
    exact_ = shared_places(exact_, exact);
    places_ = shared_places(places_, lenient);
}

std::vector<uint32_t> SequencePlaces::finish() {
    const auto is_moving = [&](uint32_t count) { return count > most_outliers_; };
    if (std::none_of(num_outliers_.begin(), num_outliers_.end(), is_moving)) {
        return std::move(places_);
    }
    // What is elsewhere too often is no outlier. Its places are the exact ones.
    std::vector<uint32_t> places = places_.empty() ? own_places(num_outliers_.size()) : places_;
    std::vector<uint32_t> kinds(places.size());
    for (uint32_t v = 0; v < places.size(); ++v) {
        kinds[v] = is_moving(num_outliers_[v]) ? 1 : 0;
        if (kinds[v] == 1) places[v] = place_of_vertex(exact_, v);
    }
    return shared_places(places, kinds);
}

}  // namespace paim
