// Programmer mistakes: always-on checks that print the condition, the place and both values.
#pragma once

#include <fmt/format.h>

#include <cstdio>
#include <cstdlib>

namespace paim::detail {

[[noreturn]] inline void check_failed(const char* file, int line, const char* what) {
    fmt::print(stderr, "{}:{}: check failed: {}\n", file, line, what);
    std::abort();
}

template <typename A, typename B>
[[noreturn]] void check_failed(const char* file, int line, const char* what, const A& a,
                               const B& b) {
    fmt::print(stderr, "{}:{}: check failed: {} (got {} and {})\n", file, line, what, a, b);
    std::abort();
}

}  // namespace paim::detail

#define PAIM_CHECK(condition) \
    ((condition) ? void() : ::paim::detail::check_failed(__FILE__, __LINE__, #condition))

#define PAIM_CHECK_COMPARE(a, op, b)                                                             \
    do {                                                                                         \
        const auto& paim_a = (a);                                                                \
        const auto& paim_b = (b);                                                                \
        if (!(paim_a op paim_b)) {                                                               \
            ::paim::detail::check_failed(__FILE__, __LINE__, #a " " #op " " #b, paim_a, paim_b); \
        }                                                                                        \
    } while (false)

#define PAIM_CHECK_EQ(a, b) PAIM_CHECK_COMPARE(a, ==, b)
#define PAIM_CHECK_LT(a, b) PAIM_CHECK_COMPARE(a, <, b)
#define PAIM_CHECK_LE(a, b) PAIM_CHECK_COMPARE(a, <=, b)
