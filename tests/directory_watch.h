// Waits for files to appear in a folder, told by the system (inotify) and not by looking again.
#pragma once

#include <limits.h>
#include <poll.h>
#include <sys/inotify.h>
#include <unistd.h>

#include <cstddef>
#include <cstring>
#include <filesystem>
#include <stdexcept>
#include <string>

namespace paim {

// Files that are created in the folder, or renamed into it, from its construction on.
class DirectoryWatch {
  public:
    explicit DirectoryWatch(const std::filesystem::path& directory)
        : events_(::inotify_init1(IN_CLOEXEC)) {
        if (events_ < 0 ||
            ::inotify_add_watch(events_, directory.c_str(), IN_CREATE | IN_MOVED_TO) < 0) {
            throw std::runtime_error(directory.string() + ": cannot be watched");
        }
    }
    ~DirectoryWatch() { ::close(events_); }
    DirectoryWatch(const DirectoryWatch&) = delete;
    DirectoryWatch& operator=(const DirectoryWatch&) = delete;

    // Waits until a file of this name appears, unless it did before the call. False if nothing at
    // all appears for five minutes: only a test that fails takes so long.
    bool wait_for(const std::string& name) {
        for (;;) {
            while (next_ < end_) {
                if (take_name() == name) return true;
            }
            constexpr int kHungAfterMs = 300'000;
            pollfd ready{events_, POLLIN, 0};
            if (::poll(&ready, 1, kHungAfterMs) <= 0) return false;
            const ssize_t got = ::read(events_, buffer_, sizeof(buffer_));
            if (got <= 0) return false;
            next_ = 0;
            end_ = static_cast<size_t>(got);
        }
    }

  private:
    std::string take_name() {
        inotify_event event;
        std::memcpy(&event, buffer_ + next_, sizeof(event));
        const char* name = buffer_ + next_ + sizeof(event);
        next_ += sizeof(event) + event.len;
        return event.len > 0 ? name : "";
    }

    int events_;
    char buffer_[16 * (sizeof(inotify_event) + NAME_MAX + 1)];
    size_t next_ = 0, end_ = 0;  // of the buffer, not yet looked at
};

}  // namespace paim
