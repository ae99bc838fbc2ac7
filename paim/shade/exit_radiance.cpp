// Radiance of glossy vertices towards an eye.
// Based on: Sloan, Kautz and Snyder 2002 (see the header)
#include "paim/shade/exit_radiance.h"

#include <algorithm>
#include <vector>

#include "paim/base/check.h"
#include "paim/base/parallel.h"
#include "paim/sh/basis.h"

namespace paim {

void exit_towards(int out_bands, std::span<const Vec3f> exit, std::span<const Vec3f> directions,
                  std::span<Vec3f> radiance) {
    constexpr size_t kBatch = sh::BatchBasis::kBatch;
    const auto num_outgoing = static_cast<size_t>(sh::num_coefficients(out_bands));
    const size_t num_rows = directions.size();
    PAIM_CHECK_EQ(exit.size(), num_outgoing * num_rows);
    PAIM_CHECK_EQ(radiance.size(), num_rows);
    const sh::BatchBasis basis(out_bands);
    constexpr size_t kBatchesATask = 64;
    parallel_for((num_rows + kBatch - 1) / kBatch, kBatchesATask, [&](size_t begin, size_t end) {
        std::vector<float> values(num_outgoing * kBatch);
        for (size_t first = begin * kBatch; first < std::min(end * kBatch, num_rows);
             first += kBatch) {
            const size_t count = std::min(kBatch, num_rows - first);
            float x[kBatch] = {}, y[kBatch] = {}, z[kBatch] = {};
            for (size_t j = 0; j < count; ++j) {
                const Vec3f& direction = directions[first + j];
                x[j] = direction.x();
                y[j] = direction.y();
                z[j] = direction.z();
            }
            basis.evaluate(x, y, z, values.data());
            for (size_t j = 0; j < count; ++j) radiance[first + j].setZero();
            for (size_t o = 0; o < num_outgoing; ++o) {
                const Vec3f* const of_row = exit.data() + o * num_rows + first;
                for (size_t j = 0; j < count; ++j) {
                    radiance[first + j] += values[o * kBatch + j] * of_row[j];
                }
            }
        }
    });
}

}  // namespace paim
