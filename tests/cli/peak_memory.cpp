// Runs a tool and says how much memory it took at its peak, in bytes. The peak of a process
// that starts a tool counts as the tool's own, because the tool's code replaces it only afterwards.
// So this program is small, and tests, which are large, start tools through it.
#include <fcntl.h>
#include <spawn.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cstdio>
#include <cstring>

extern char** environ;

// arguments[1] is the path of the tool, the rest are its arguments. The tool's standard output is
// thrown away. Exits as the tool did; with 128 and the signal if one ended it; with 127 if it
// cannot be started.
int main(int, char** arguments) {
    posix_spawn_file_actions_t actions;
    posix_spawn_file_actions_init(&actions);
    posix_spawn_file_actions_addopen(&actions, STDOUT_FILENO, "/dev/null", O_WRONLY, 0);
    pid_t tool = 0;
    const int failure =
        ::posix_spawn(&tool, arguments[1], &actions, nullptr, arguments + 1, environ);
    posix_spawn_file_actions_destroy(&actions);
    if (failure != 0) {
        std::fprintf(stderr, "%s: %s\n", arguments[1], std::strerror(failure));
        return 127;
    }
    int status = 0;
    rusage usage{};
    if (::wait4(tool, &status, 0, &usage) != tool) return 127;
    std::printf("%ld\n", usage.ru_maxrss * 1024);
    return WIFSIGNALED(status) ? 128 + WTERMSIG(status) : WEXITSTATUS(status);
}
