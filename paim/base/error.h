// Foreseeable failures: what went wrong, where, what was expected, what was got, and the exit code.
#pragma once

#include <initializer_list>
#include <stdexcept>
#include <string>
#include <string_view>
#include <type_traits>

#include "paim/base/export.h"
#include "paim/base/message.h"

namespace paim {

// Exit codes of every Paim tool.
enum class ExitCode : int {
    ok = 0,
    usage = 1,               // the command line makes no sense
    bad_input = 2,           // a file or mesh is missing, damaged or inconsistent
    unsupported = 3,         // valid input, but this build cannot handle it
    output_failed = 4,       // the result could not be written
    threshold_exceeded = 5,  // the result misses the error that was asked for
};

class PAIM_EXPORT Error : public std::runtime_error {
  public:
    Error(ExitCode code, const std::string& message) : std::runtime_error(message), code_(code) {}
    ExitCode code() const { return code_; }

  private:
    ExitCode code_;
};

[[noreturn]] PAIM_EXPORT void throw_error(ExitCode code, std::string_view format,
                                          std::initializer_list<MessageValue> values);

// Formats as in message.h.
template <typename... Values>
[[noreturn]] void throw_usage(MessageFormat<std::type_identity_t<Values>...> format,
                              const Values&... values) {
    throw_error(ExitCode::usage, format.text(), {detail::message_value(values)...});
}

template <typename... Values>
[[noreturn]] void throw_bad_input(MessageFormat<std::type_identity_t<Values>...> format,
                                  const Values&... values) {
    throw_error(ExitCode::bad_input, format.text(), {detail::message_value(values)...});
}

template <typename... Values>
[[noreturn]] void throw_unsupported(MessageFormat<std::type_identity_t<Values>...> format,
                                    const Values&... values) {
    throw_error(ExitCode::unsupported, format.text(), {detail::message_value(values)...});
}

template <typename... Values>
[[noreturn]] void throw_output_failed(MessageFormat<std::type_identity_t<Values>...> format,
                                      const Values&... values) {
    throw_error(ExitCode::output_failed, format.text(), {detail::message_value(values)...});
}

}  // namespace paim
