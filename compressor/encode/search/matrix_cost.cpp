// What a quantised matrix costs in a file.
#include "compressor/encode/search/matrix_cost.h"

#include <numeric>
#include <vector>

#include "paim/base/parallel.h"
#include "paim/format/container/container.h"
#include "paim/format/pack/plane_encoder.h"

namespace paim {

uint64_t stored_bytes(const LowRankMatrix& matrix, const PlanePredictor& predictor, Effort effort) {
    // A section has an entry in the table and ends, on average, in the middle of its last 64 bytes.
    constexpr uint64_t kSectionBytes = sizeof(container::TableEntry) + container::kAlignment / 2;
    std::vector<uint64_t> bytes(matrix.components.size() + 1);
    parallel_for(bytes.size(), 1, [&](size_t j, size_t) {
        const StoredValues& values = j == 0 ? matrix.mean : matrix.components[j - 1];
        bytes[j] = kSectionBytes +
                   (values.holds_floats()
                        ? values.size_bytes()
                        : encode_planes(values, matrix.num_planes, predictor, effort).size());
    });
    // Weights of a smooth motion take about one byte each.
    return std::accumulate(bytes.begin(), bytes.end(), uint64_t{matrix.weights.size()});
}

}  // namespace paim
