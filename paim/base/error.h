// Foreseeable failures: what went wrong, where, what was expected, what was got, and the exit code.
#pragma once

#include <fmt/format.h>

#include <stdexcept>
#include <string>
#include <utility>

namespace paim {

// Exit codes of every Paim tool.
enum class ExitCode : int {
    ok = 0,
    usage = 1,               // the command line makes no sense
    bad_input = 2,           // a file or mesh is missing, damaged or inconsistent
    unsupported = 3,         // valid, but not something this build can do
    output_failed = 4,       // the result could not be written
    threshold_exceeded = 5,  // the result misses the error that was asked for
};

class Error : public std::runtime_error {
  public:
    Error(ExitCode code, const std::string& message) : std::runtime_error(message), code_(code) {}
    ExitCode code() const { return code_; }

  private:
    ExitCode code_;
};

template <typename... Args>
[[noreturn]] void throw_usage(fmt::format_string<Args...> format, Args&&... args) {
    throw Error(ExitCode::usage, fmt::format(format, std::forward<Args>(args)...));
}

template <typename... Args>
[[noreturn]] void throw_bad_input(fmt::format_string<Args...> format, Args&&... args) {
    throw Error(ExitCode::bad_input, fmt::format(format, std::forward<Args>(args)...));
}

template <typename... Args>
[[noreturn]] void throw_unsupported(fmt::format_string<Args...> format, Args&&... args) {
    throw Error(ExitCode::unsupported, fmt::format(format, std::forward<Args>(args)...));
}

template <typename... Args>
[[noreturn]] void throw_output_failed(fmt::format_string<Args...> format, Args&&... args) {
    throw Error(ExitCode::output_failed, fmt::format(format, std::forward<Args>(args)...));
}

}  // namespace paim
