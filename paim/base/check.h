// Programmer mistakes: always-on checks that print the condition, the place and both values.
#pragma once

#include <initializer_list>

#include "paim/base/export.h"
#include "paim/base/message.h"

namespace paim::detail {

// Prints "FILE:LINE: check failed: WHAT", and both values where there are two, and aborts.
[[noreturn]] PAIM_EXPORT void check_failed(const char* file, int line, const char* what,
                                           std::initializer_list<MessageValue> values = {});

}  // namespace paim::detail

#define PAIM_CHECK(condition) \
    ((condition) ? void() : ::paim::detail::check_failed(__FILE__, __LINE__, #condition))

#define PAIM_CHECK_COMPARE(a, op, b)                                                             \
    do {                                                                                         \
        const auto& paim_a = (a);                                                                \
        const auto& paim_b = (b);                                                                \
        if (!(paim_a op paim_b)) {                                                               \
            ::paim::detail::check_failed(                                                        \
                __FILE__, __LINE__, #a " " #op " " #b,                                           \
                {::paim::detail::message_value(paim_a), ::paim::detail::message_value(paim_b)}); \
        }                                                                                        \
    } while (false)

#define PAIM_CHECK_EQ(a, b) PAIM_CHECK_COMPARE(a, ==, b)
#define PAIM_CHECK_LT(a, b) PAIM_CHECK_COMPARE(a, <, b)
#define PAIM_CHECK_LE(a, b) PAIM_CHECK_COMPARE(a, <=, b)
