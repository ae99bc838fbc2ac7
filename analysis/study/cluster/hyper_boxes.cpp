// The first means of clusters by boxes.
#include "analysis/study/cluster/hyper_boxes.h"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

namespace paim::study {

namespace {

using Eigen::Index;

struct Box {
    std::vector<Index> points;
    Index axis = 0;  // of the longest side
    float middle = 0.0f, side = 0.0f;
};

Box shrink(const Eigen::MatrixXf& points, std::vector<Index> members) {
    Eigen::VectorXf low = points.col(members[0]), high = low;
    for (const Index v : members) {
        low = low.cwiseMin(points.col(v));
        high = high.cwiseMax(points.col(v));
    }
    Box box;
    box.points = std::move(members);
    box.side = (high - low).maxCoeff(&box.axis);
    // Rounding must not lift the middle to the upper end, above which no point is.
    box.middle =
        std::min(low[box.axis] + 0.5f * box.side, std::nextafter(high[box.axis], low[box.axis]));
    return box;
}

}  // namespace

Eigen::MatrixXf hyper_box_means(const Eigen::MatrixXf& points, uint32_t num_boxes) {
    std::vector<Index> all(static_cast<size_t>(points.cols()));
    for (size_t v = 0; v < all.size(); ++v) all[v] = static_cast<Index>(v);
    std::vector<Box> boxes{shrink(points, std::move(all))};
    const auto is_shorter = [](const Box& a, const Box& b) { return a.side < b.side; };
    while (boxes.size() < num_boxes) {
        const auto longest = std::max_element(boxes.begin(), boxes.end(), is_shorter);
        if (!(longest->side > 0.0f)) break;
        std::vector<Index> below, above;
        for (const Index v : longest->points) {
            (points(longest->axis, v) > longest->middle ? above : below).push_back(v);
        }
        *longest = shrink(points, std::move(below));
        boxes.push_back(shrink(points, std::move(above)));
    }
    Eigen::MatrixXf means(points.rows(), static_cast<Index>(boxes.size()));
    for (size_t b = 0; b < boxes.size(); ++b) {
        Eigen::VectorXd sum = Eigen::VectorXd::Zero(points.rows());
        for (const Index v : boxes[b].points) sum += points.col(v).cast<double>();
        means.col(static_cast<Index>(b)) =
            (sum / static_cast<double>(boxes[b].points.size())).cast<float>();
    }
    return means;
}

}  // namespace paim::study
