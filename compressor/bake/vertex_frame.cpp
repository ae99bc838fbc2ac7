// The frame of a vertex.
#include "compressor/bake/vertex_frame.h"

#include "paim/base/orthonormal_basis.h"
#include "paim/sh/index.h"

namespace paim {

namespace {

Eigen::Matrix3d axes_of(const Vec3f& normal) {
    const Vec3d z = normal.cast<double>().normalized();
    Vec3d x, y;
    orthonormal_basis(z, x, y);
    Eigen::Matrix3d axes;
    axes << x, y, z;
    return axes;
}

}  // namespace

VertexFrame::VertexFrame(int bands, const Vec3f& normal)
    : axes_(axes_of(normal)), to_pose_(bands, axes_) {}

void VertexFrame::directions_to_frame(const RaySet& rays, size_t first, float* x, float* y,
                                      float* z) const {
    const Eigen::Matrix3f axes = axes_.cast<float>();
    float* const to[3] = {x, y, z};
    for (int axis = 0; axis < 3; ++axis) {
        const float ax = axes(0, axis), ay = axes(1, axis), az = axes(2, axis);
        for (size_t j = 0; j < 16; ++j) {
            to[axis][j] = ax * rays.x[first + j] + ay * rays.y[first + j] + az * rays.z[first + j];
        }
    }
}

void VertexFrame::rows_to_pose(std::span<const int> coefficients, size_t num_columns,
                               const double* rows, double* out) const {
    for (const int coefficient : coefficients) {
        const int l = sh::band_of(coefficient);
        const Eigen::MatrixXd& block = to_pose_.block(l);
        for (int m = -l; m <= l; ++m) {
            const double factor = block(l + m, coefficient - sh::index(l, -l));
            double* const to = out + static_cast<size_t>(sh::index(l, m)) * num_columns;
            for (size_t i = 0; i < num_columns; ++i) to[i] += factor * rows[i];
        }
        rows += num_columns;
    }
}

}  // namespace paim
