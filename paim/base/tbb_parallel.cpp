// Parallel loops on oneTBB, and a limit on its threads.
#include "paim/base/tbb_parallel.h"

#include <tbb/global_control.h>
#include <tbb/parallel_for.h>

#include <optional>

#include "paim/base/check.h"
#include "paim/base/parallel_hook.h"

namespace paim {

struct ThreadLimit::Control {
    std::optional<tbb::global_control> limit;
};

ThreadLimit::ThreadLimit(int num_threads) : control_(std::make_unique<Control>()) {
    PAIM_CHECK(num_threads >= 0);
    if (num_threads > 0) {
        control_->limit.emplace(tbb::global_control::max_allowed_parallelism,
                                static_cast<size_t>(num_threads));
    }
}

ThreadLimit::~ThreadLimit() = default;

void use_tbb() {
    static const ParallelHook hook{
        [](void*, size_t count, void (*body)(void*, size_t), void* context) {
            tbb::parallel_for(size_t{0}, count, [&](size_t index) { body(context, index); });
        },
        [](void*) {
            return static_cast<int>(
                tbb::global_control::active_value(tbb::global_control::max_allowed_parallelism));
        },
        nullptr};
    set_parallel_hook(&hook);
}

}  // namespace paim
