// Parallel loops and the thread limit, on oneTBB.
#include "paim/base/parallel.h"

#include <tbb/global_control.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <optional>

#include "paim/base/check.h"

namespace paim {

struct ThreadLimit::Control {
    std::optional<tbb::global_control> limit;
};

void parallel_for(size_t count, size_t grain, const std::function<void(size_t, size_t)>& body) {
    PAIM_CHECK(grain > 0);
    const size_t num_pieces = (count + grain - 1) / grain;
    tbb::parallel_for(size_t{0}, num_pieces, [&](size_t piece) {
        body(piece * grain, std::min(count, (piece + 1) * grain));
    });
}

ThreadLimit::ThreadLimit(int num_threads) : control_(std::make_unique<Control>()) {
    PAIM_CHECK(num_threads >= 0);
    if (num_threads > 0) {
        control_->limit.emplace(tbb::global_control::max_allowed_parallelism,
                                static_cast<size_t>(num_threads));
    }
}

ThreadLimit::~ThreadLimit() = default;

int max_parallelism() {
    return static_cast<int>(
        tbb::global_control::active_value(tbb::global_control::max_allowed_parallelism));
}

}  // namespace paim
