// The hook by which a program lets loops inside Paim run on its threads. Without a hook every loop
// runs on the thread that starts it. Results have the same bytes either way.
#pragma once

#include <cstddef>

#include "paim/base/export.h"

namespace paim {

struct ParallelHook {
    // Calls body(context, index) once for every index below `count`, in any order and on any
    // threads, and returns when all calls have returned. `body` does not throw. Loops start on
    // several threads at once, and within other loops.
    void (*parallel_for)(void* user, size_t count, void (*body)(void* context, size_t index),
                         void* context) = nullptr;
    // How many threads a loop that starts now can use, at least 1.
    int (*max_parallelism)(void* user) = nullptr;
    void* user = nullptr;  // given to both functions
};

// Loops that start from now on use the hook, which the caller keeps alive while they run.
// hook  nullptr: no hook
PAIM_EXPORT void set_parallel_hook(const ParallelHook* hook);

}  // namespace paim
