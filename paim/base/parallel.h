// Loops over all cores that the program offers (parallel_hook.h). Work is cut by index, never by
// thread, so that results are the same on any number of threads.
#pragma once

#include <cstddef>
#include <functional>

namespace paim {

// Calls body(begin, end) for consecutive pieces of [0, count) of exactly `grain` items (the last
// one may be shorter), in any order and on any thread. Rethrows the first exception.
void parallel_for(size_t count, size_t grain, const std::function<void(size_t, size_t)>& body);

// Threads that parallel loops may use now, at least 1.
int max_parallelism();

}  // namespace paim
