// Runs a built tool as a child process, as a user would, and keeps all it says.
#pragma once

#include <fcntl.h>
#include <poll.h>
#include <signal.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <chrono>
#include <cstring>
#include <functional>
#include <stdexcept>
#include <string>
#include <vector>

extern char** environ;

namespace paim {

struct ToolResult {
    int exit_code = -1;  // -N if signal N ended the tool
    std::string out;
    std::string err;
};

namespace detail {

// A pipe whose ends close by themselves; the tool inherits neither beyond what run_tool hands over.
class Pipe {
  public:
    Pipe() {
        if (::pipe2(ends_.data(), O_CLOEXEC) != 0) throw std::runtime_error("pipe2 failed");
    }
    ~Pipe() {
        close_read();
        close_write();
    }
    Pipe(const Pipe&) = delete;
    Pipe& operator=(const Pipe&) = delete;

    int read_end() const { return ends_[0]; }
    int write_end() const { return ends_[1]; }
    void close_read() { close(ends_[0]); }
    void close_write() { close(ends_[1]); }

    // Appends what is there to the text; closes the read end when the tool has closed its own.
    void drain(std::string& text) {
        std::array<char, 65536> buffer;
        const ssize_t got = ::read(ends_[0], buffer.data(), buffer.size());
        if (got > 0) text.append(buffer.data(), static_cast<size_t>(got));
        if (got == 0 || (got < 0 && errno != EINTR)) close_read();
    }

  private:
    static void close(int& end) {
        if (end >= 0) ::close(end);
        end = -1;
    }
    std::array<int, 2> ends_{-1, -1};
};

}  // namespace detail

// Starts arguments[0] (a path) with the rest as its arguments and an empty standard input, and
// waits for it. Throws std::runtime_error if it cannot be started, or if it still runs after 10
// minutes, when it is killed.
// on_output  is called with all that the tool has said, whenever it says more
inline ToolResult run_tool(const std::vector<std::string>& arguments,
                           const std::function<void(const ToolResult&)>& on_output = {}) {
    if (arguments.empty()) throw std::runtime_error("run_tool needs the path of a tool");
    detail::Pipe out, err;
    std::vector<char*> argv;
    for (const std::string& argument : arguments) {
        argv.push_back(const_cast<char*>(argument.c_str()));  // posix_spawn does not write to them
    }
    argv.push_back(nullptr);

    posix_spawn_file_actions_t actions;
    posix_spawn_file_actions_init(&actions);
    posix_spawn_file_actions_addopen(&actions, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
    posix_spawn_file_actions_adddup2(&actions, out.write_end(), STDOUT_FILENO);
    posix_spawn_file_actions_adddup2(&actions, err.write_end(), STDERR_FILENO);
    pid_t child = 0;
    const int failure = ::posix_spawn(&child, argv[0], &actions, nullptr, argv.data(), environ);
    posix_spawn_file_actions_destroy(&actions);
    if (failure != 0) throw std::runtime_error(arguments[0] + ": " + std::strerror(failure));
    out.close_write();
    err.close_write();

    // Both pipes are drained together, so that a tool that fills one never waits for us.
    using Clock = std::chrono::steady_clock;
    const auto deadline = Clock::now() + std::chrono::minutes(10);
    ToolResult result;
    bool late = false;
    while (!late && (out.read_end() >= 0 || err.read_end() >= 0)) {
        std::array<pollfd, 2> ends{
            {{out.read_end(), POLLIN, 0}, {err.read_end(), POLLIN, 0}}};  // poll skips fd -1
        const int num_ready = ::poll(ends.data(), ends.size(), 1000);
        if (num_ready > 0 && ends[0].revents != 0) out.drain(result.out);
        if (num_ready > 0 && ends[1].revents != 0) err.drain(result.err);
        if (num_ready > 0 && on_output) on_output(result);
        late = Clock::now() > deadline;
    }
    int status = 0;
    pid_t waited = 0;
    while (!late && waited != child) {  // normally ends at once: closed pipes mean that it is going
        waited = ::waitpid(child, &status, WNOHANG);
        if (waited < 0 && errno != EINTR) throw std::runtime_error("waitpid failed");
        if (waited == 0) ::poll(nullptr, 0, 1);
        late = waited != child && Clock::now() > deadline;
    }
    if (late) {
        ::kill(child, SIGKILL);
        ::waitpid(child, &status, 0);
        throw std::runtime_error(arguments[0] + ": still running after 10 minutes; killed");
    }
    result.exit_code = WIFSIGNALED(status) ? -WTERMSIG(status) : WEXITSTATUS(status);
    return result;
}

}  // namespace paim
