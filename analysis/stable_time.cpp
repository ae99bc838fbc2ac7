// Times that come out the same when they are measured again.
#include "analysis/stable_time.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <fstream>
#include <vector>

#include "paim/base/check.h"
#include "paim/base/median.h"
#include "paim/base/parallel.h"

namespace paim {

namespace {

using Clock = std::chrono::steady_clock;

constexpr uint32_t kPosesPerRound = 32;
constexpr size_t kLeastRounds = 5;
constexpr double kEnough = 0.025;

double seconds_since(Clock::time_point start) {
    return std::chrono::duration<double>(Clock::now() - start).count();
}

// The standard error of a median, from the quartiles, which outliers do not move: of a normal
// distribution 1.25 σ / √n, and σ is 0.74 times the distance of the quartiles.
double relative_error_of_median(std::vector<double> values) {
    std::sort(values.begin(), values.end());
    const size_t n = values.size();
    const double middle = values[n / 2];
    if (n < 4 || middle <= 0.0) return 1.0;
    const double deviation = 0.74 * (values[3 * n / 4] - values[n / 4]);
    return 1.25 * deviation / std::sqrt(static_cast<double>(n)) / middle;
}

}  // namespace

PoseTime time_poses(uint32_t num_poses, const std::function<void(uint32_t pose)>& work,
                    double most_seconds) {
    PAIM_CHECK_LE(1u, num_poses);
    uint32_t count = std::min(num_poses, kPosesPerRound);
    const auto run = [&] {
        const auto start = Clock::now();
        for (uint32_t j = 0; j < count; ++j) {
            work(static_cast<uint32_t>(uint64_t{j} * num_poses / count));
        }
        return 1e3 * seconds_since(start) / count;
    };
    const auto start = Clock::now();
    work(0);  // which may take memory
    const double one_s = seconds_since(start);
    const double affordable = most_seconds / (static_cast<double>(kLeastRounds + 1) * one_s);
    count = affordable < count ? std::max(1u, static_cast<uint32_t>(affordable)) : count;
    run();
    std::vector<double> rounds;
    double error = 1.0;
    while (rounds.size() < kLeastRounds ||
           (error > kEnough && seconds_since(start) < most_seconds)) {
        rounds.push_back(run());
        error = relative_error_of_median(rounds);
    }
    return {median(rounds), error};
}

std::string machine_name() {
    std::ifstream file("/proc/cpuinfo");
    std::string line, model = "unknown processor";
    while (std::getline(file, line)) {
        const size_t colon = line.find(": ");
        if (line.starts_with("model name") && colon != std::string::npos) {
            model = line.substr(colon + 2);
            break;
        }
    }
    const int num_threads = max_parallelism();
    return fmt::format("{}, {} {}", model, num_threads, num_threads == 1 ? "thread" : "threads");
}

}  // namespace paim
