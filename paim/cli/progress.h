// Progress of long work: a bar with rate and time left on a terminal, plain lines elsewhere.
#pragma once

#include <chrono>
#include <cstdint>
#include <mutex>
#include <string>

namespace paim::cli {

// Writes to stderr, so that stdout stays for results. Thread-safe.
class Progress {
  public:
    // `quiet` prints nothing. `unit` names what is counted, e.g. "poses".
    Progress(std::string label, std::string unit, uint64_t total, bool quiet);
    ~Progress();
    Progress(const Progress&) = delete;
    Progress& operator=(const Progress&) = delete;

    void advance(uint64_t amount = 1);

    // From the next line on.
    void set_label(std::string label);

    // The last line, with the time the work took. Without it (an error), the bar's line is just
    // ended.
    void finish();

  private:
    using Clock = std::chrono::steady_clock;
    void print(bool last);

    std::string label_;
    std::string unit_;
    uint64_t total_;
    uint64_t done_ = 0;
    bool quiet_;
    bool terminal_;
    bool bar_open_ = false;
    Clock::time_point start_;
    Clock::time_point last_print_;
    std::mutex mutex_;
};

// "1.2 s", "3 min 05 s", "2 h 10 min".
std::string format_duration(double seconds);

}  // namespace paim::cli
