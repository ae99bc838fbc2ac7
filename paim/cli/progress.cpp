// Progress bars and plain progress lines.
#include "paim/cli/progress.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <utility>

namespace paim::cli {

std::string format_duration(double seconds) {
    if (seconds < 59.95) return fmt::format("{:.1f} s", seconds);
    const auto whole = static_cast<uint64_t>(seconds + 0.5);
    if (whole < 3600) return fmt::format("{} min {:02} s", whole / 60, whole % 60);
    return fmt::format("{} h {:02} min", whole / 3600, whole % 3600 / 60);
}

Progress::Progress(std::string label, std::string unit, uint64_t total, bool quiet)
    : label_(std::move(label)),
      unit_(std::move(unit)),
      total_(total),
      quiet_(quiet),
      terminal_(::isatty(STDERR_FILENO) == 1),
      start_(Clock::now()),
      last_print_(start_) {}

Progress::~Progress() {
    if (bar_open_) fmt::print(stderr, "\n");
}

void Progress::advance(uint64_t amount) {
    const std::lock_guard lock(mutex_);
    done_ += amount;
    const auto interval = terminal_ ? std::chrono::milliseconds(100) : std::chrono::seconds(10);
    if (quiet_ || Clock::now() - last_print_ < interval) return;
    last_print_ = Clock::now();
    print(false);
}

void Progress::set_label(std::string label) {
    const std::lock_guard lock(mutex_);
    label_ = std::move(label);
}

void Progress::finish() {
    const std::lock_guard lock(mutex_);
    if (!quiet_) print(true);
}

void Progress::print(bool last) {
    const double elapsed_s = std::chrono::duration<double>(Clock::now() - start_).count();
    const double rate = elapsed_s > 0.0 ? static_cast<double>(done_) / elapsed_s : 0.0;
    const double left_s =
        rate > 0.0 ? static_cast<double>(total_ - std::min(done_, total_)) / rate : 0.0;
    std::string line;
    if (last) {
        line = fmt::format("{}: {} {} in {}", label_, done_, unit_, format_duration(elapsed_s));
    } else {
        line = fmt::format("{}: {}/{} {}, {:.3g} {}/s, {} left", label_, done_, total_, unit_, rate,
                           unit_, format_duration(left_s));
    }
    if (terminal_) {
        constexpr size_t kBarWidth = 24;
        const size_t filled =
            total_ > 0 ? std::min<uint64_t>(kBarWidth, done_ * kBarWidth / total_) : 0;
        const std::string bar = std::string(filled, '#') + std::string(kBarWidth - filled, '.');
        fmt::print(stderr, "\r\x1b[K[{}] {}{}", bar, line, last ? "\n" : "");
        bar_open_ = !last;
    } else {
        fmt::print(stderr, "{}\n", line);
    }
}

}  // namespace paim::cli
