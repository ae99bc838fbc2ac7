// What the allocator keeps of memory that was freed.
#pragma once

#include <cstdint>

namespace paim {

// Measured with glibc: a process that needs so many bytes at its peak holds up to a quarter more.
constexpr uint64_t with_memory_slack(uint64_t bytes) {
    return bytes / 4 * 5;
}

// The most bytes whose with_memory_slack() stays below these.
constexpr uint64_t without_memory_slack(uint64_t bytes) {
    return bytes / 5 * 4;
}

}  // namespace paim
