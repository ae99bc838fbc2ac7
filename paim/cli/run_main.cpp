// Exceptions to messages and exit codes.
#include "paim/cli/run_main.h"

#include <fmt/format.h>

#include <exception>
#include <new>

#include "paim/base/error.h"

namespace paim::cli {

int run_main(std::string_view tool, const std::function<int()>& body) {
    try {
        return body();
    } catch (const Error& error) {
        fmt::print(stderr, "{}: {}\n", tool, error.what());
        return static_cast<int>(error.code());
    } catch (const std::bad_alloc&) {
        fmt::print(stderr, "{}: out of memory\n", tool);
        return static_cast<int>(ExitCode::output_failed);
    } catch (const std::exception& error) {
        fmt::print(stderr, "{}: unexpected error: {}\n", tool, error.what());
        return static_cast<int>(ExitCode::bad_input);
    }
}

}  // namespace paim::cli
