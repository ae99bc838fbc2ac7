// An X server without a screen (Xvfb), for as long as a test needs a display.
#pragma once

#include <fcntl.h>
#include <poll.h>
#include <signal.h>
#include <spawn.h>
#include <stdlib.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <stdexcept>
#include <string>

extern char** environ;

namespace paim::player {

class XServer {
  public:
    // Starts Xvfb on a display that it finds free, and points DISPLAY at it.
    explicit XServer(const std::string& program) {
        std::array<int, 2> ends{};
        if (::pipe2(ends.data(), O_CLOEXEC) != 0) throw std::runtime_error("pipe2 failed");
        // Xvfb writes the number of its display into descriptor 3.
        const std::array<std::string, 9> arguments = {program,     "-displayfd", "3",
                                                      "-screen",   "0",          "1280x1024x24",
                                                      "-nolisten", "tcp",        "-noreset"};
        std::array<char*, 10> argv{};
        for (size_t i = 0; i < arguments.size(); ++i) {
            argv[i] =
                const_cast<char*>(arguments[i].c_str());  // posix_spawn does not write to them
        }
        posix_spawn_file_actions_t actions;
        posix_spawn_file_actions_init(&actions);
        posix_spawn_file_actions_adddup2(&actions, ends[1], 3);
        posix_spawn_file_actions_addopen(&actions, STDERR_FILENO, "/dev/null", O_WRONLY, 0);
        const int failure =
            ::posix_spawn(&child_, program.c_str(), &actions, nullptr, argv.data(), environ);
        posix_spawn_file_actions_destroy(&actions);
        ::close(ends[1]);
        const std::string number = failure == 0 ? read_line(ends[0]) : std::string();
        ::close(ends[0]);
        if (number.empty()) {
            stop();
            throw std::runtime_error(program + " does not start");
        }
        ::setenv("DISPLAY", (":" + number).c_str(), 1);
    }
    ~XServer() { stop(); }
    XServer(const XServer&) = delete;
    XServer& operator=(const XServer&) = delete;

  private:
    // Up to the end of line, for at most 30 seconds without a word.
    static std::string read_line(int descriptor) {
        std::string line;
        char letter = 0;
        pollfd end{descriptor, POLLIN, 0};
        while (::poll(&end, 1, 30000) > 0 && ::read(descriptor, &letter, 1) == 1) {
            if (letter == '\n') return line;
            line += letter;
        }
        return {};
    }
    void stop() {
        if (child_ <= 0) return;
        ::kill(child_, SIGTERM);
        ::waitpid(child_, nullptr, 0);
        child_ = 0;
        ::unsetenv("DISPLAY");
    }

    pid_t child_ = 0;
};

}  // namespace paim::player
