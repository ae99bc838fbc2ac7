// Memory that starts at a cache line.
#pragma once

#include <cstddef>
#include <new>

namespace paim {

// For vectors. Values that resize() adds are undefined.
template <typename T>
struct LineAllocator {
    using value_type = T;
    static constexpr std::align_val_t kLine{64};

    LineAllocator() = default;
    template <typename Other>
    LineAllocator(const LineAllocator<Other>&) {}

    T* allocate(size_t count) { return static_cast<T*>(::operator new(count * sizeof(T), kLine)); }
    void deallocate(T* values, size_t) { ::operator delete(values, kLine); }

    template <typename Value>
    void construct(Value* value) {
        ::new (static_cast<void*>(value)) Value;
    }

    bool operator==(const LineAllocator&) const { return true; }
};

}  // namespace paim
