// How long something takes once.
#pragma once

#include <chrono>

namespace paim {

// Seconds that `work` takes.
template <typename Work>
double seconds_of(const Work& work) {
    const auto start = std::chrono::steady_clock::now();
    work();
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

}  // namespace paim
