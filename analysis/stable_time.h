// Times that come out the same when they are measured again.
#pragma once

#include <cstdint>
#include <functional>
#include <string>

namespace paim {

// How long something takes for one pose of a sequence.
struct PoseTime {
    double median_ms = 0.0;
    // How well the median is known: its standard error, relative.
    double relative_error = 0.0;
};

// For most_seconds below, where many files are timed.
constexpr double kQuickSeconds = 0.5;

// Runs `work` for poses of the whole sequence in rounds, until the median over the rounds is known to
// 2.5 %, or most_seconds have passed. Rounds are of up to 32 poses, of fewer where work is slow. There are
// at least five, and one before them that does not count.
// num_poses  at least 1 (checked)
PoseTime time_poses(uint32_t num_poses, const std::function<void(uint32_t pose)>& work,
                    double most_seconds = 2.0);

// The processor and the number of threads, as charts of times say it.
std::string machine_name();

}  // namespace paim
