// Exceptions to messages and exit codes.
#include "paim/cli/run_main.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <signal.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <exception>
#include <filesystem>
#include <new>
#include <system_error>

#include "paim/base/error.h"
#include "paim/base/tbb_parallel.h"

namespace paim::cli {

namespace {

// Gives standard streams that the caller closed a place, so that no file that is opened later gets
// theirs and finds messages among its bytes. Writing results to a closed output stays an error.
void hold_standard_streams() {
    for (const int stream : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO}) {
        if (::fcntl(stream, F_GETFD) != -1) continue;
        ::open("/dev/null", stream == STDERR_FILENO ? O_WRONLY : O_RDONLY);  // the lowest free one
    }
}

}  // namespace

int run_main(std::string_view tool, const std::function<int()>& body) {
    hold_standard_streams();
    // A write beyond the limit on file sizes shall fail with a message instead of killing the tool.
    ::signal(SIGXFSZ, SIG_IGN);
    use_tbb();
    try {
        const int exit_code = body();
        if (std::fflush(stdout) != 0 || std::ferror(stdout) != 0) {
            throw_output_failed("standard output: cannot write: {}", std::strerror(errno));
        }
        return exit_code;
    } catch (const Error& error) {
        fmt::print(stderr, "{}: {}\n", tool, error.what());
        return static_cast<int>(error.code());
    } catch (const std::bad_alloc&) {
        fmt::print(stderr, "{}: out of memory\n", tool);
        return static_cast<int>(ExitCode::output_failed);
    } catch (const std::filesystem::filesystem_error& error) {
        fmt::print(stderr, "{}: {}\n", tool, error.what());
        return static_cast<int>(ExitCode::bad_input);
    } catch (const std::system_error& error) {  // fmt could not write to standard output
        fmt::print(stderr, "{}: {}\n", tool, error.what());
        return static_cast<int>(ExitCode::output_failed);
    } catch (const std::exception& error) {
        fmt::print(stderr, "{}: unexpected error: {}\n", tool, error.what());
        return static_cast<int>(ExitCode::bad_input);
    }
}

}  // namespace paim::cli
