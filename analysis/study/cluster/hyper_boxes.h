// The first means of clusters by boxes.
// Based on: Chen, thesis on clustered principal components for glossy precomputed radiance transfer,
//           2005 (hyper-boxes)
#pragma once

#include <Eigen/Core>

#include <cstdint>

namespace paim::study {

// The bounding box of all points is cut in two, and again, until there are so many boxes. The box with
// the longest side is next: it is cut across the middle of that side, and both parts shrink to the
// points in them, so that no box is ever empty. Of equal sides the first box and the first coordinate
// count.
// points   [d][V], at least one
// returns  [d][boxes] the means of the points in each box; fewer than num_boxes if there are fewer
//          different points
Eigen::MatrixXf hyper_box_means(const Eigen::MatrixXf& points, uint32_t num_boxes);

}  // namespace paim::study
