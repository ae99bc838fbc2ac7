// Parallel loops, on the program's hook or on the calling thread.
#include "paim/base/parallel.h"

#include <algorithm>
#include <atomic>
#include <exception>

#include "paim/base/check.h"
#include "paim/base/parallel_hook.h"

namespace paim {

namespace {

std::atomic<const ParallelHook*> current_hook{nullptr};

// A loop whose pieces the hook runs. Exceptions do not pass through the hook, which may be C code:
// the first exception is kept, and pieces that have not started are skipped.
struct Loop {
    size_t count, grain;
    const std::function<void(size_t, size_t)>& body;
    std::atomic<bool> failed{false};
    std::exception_ptr failure;

    void run(size_t piece) { body(piece * grain, std::min(count, (piece + 1) * grain)); }

    static void run_guarded(void* context, size_t piece) {
        Loop& loop = *static_cast<Loop*>(context);
        if (loop.failed.load(std::memory_order_relaxed)) return;
        try {
            loop.run(piece);
        } catch (...) {
            if (!loop.failed.exchange(true)) loop.failure = std::current_exception();
        }
    }
};

}  // namespace

void set_parallel_hook(const ParallelHook* hook) {
    PAIM_CHECK(hook == nullptr || hook->parallel_for != nullptr);
    PAIM_CHECK(hook == nullptr || hook->max_parallelism != nullptr);
    current_hook.store(hook);
}

void parallel_for(size_t count, size_t grain, const std::function<void(size_t, size_t)>& body) {
    PAIM_CHECK(grain > 0);
    const size_t num_pieces = (count + grain - 1) / grain;
    Loop loop{count, grain, body, {false}, nullptr};
    const ParallelHook* const hook = current_hook.load(std::memory_order_acquire);
    if (hook == nullptr || num_pieces < 2) {
        for (size_t piece = 0; piece < num_pieces; ++piece) loop.run(piece);
        return;
    }
    hook->parallel_for(hook->user, num_pieces, Loop::run_guarded, &loop);
    if (loop.failure) std::rethrow_exception(loop.failure);
}

int max_parallelism() {
    const ParallelHook* const hook = current_hook.load(std::memory_order_acquire);
    return hook == nullptr ? 1 : std::max(hook->max_parallelism(hook->user), 1);
}

}  // namespace paim
