// Two ways to do the same work, timed in turns, so that what else the machine does hits both alike.
#pragma once

#include <benchmark/benchmark.h>
#include <time.h>

#include <algorithm>
#include <vector>

namespace paim::bench {

struct Times {
    double wall_s = 0.0;
    double cpu_s = 0.0;  // of all threads of this process
};

inline double seconds(clockid_t clock) {
    timespec now{};
    clock_gettime(clock, &now);
    return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

template <typename Body>
Times timed(Body&& body) {
    const double wall_s = seconds(CLOCK_MONOTONIC);
    const double cpu_s = seconds(CLOCK_PROCESS_CPUTIME_ID);
    body();
    return {seconds(CLOCK_MONOTONIC) - wall_s, seconds(CLOCK_PROCESS_CPUTIME_ID) - cpu_s};
}

inline double median(std::vector<double> values) {
    if (values.empty()) return 0.0;
    std::sort(values.begin(), values.end());
    const size_t half = values.size() / 2;
    return values.size() % 2 == 1 ? values[half] : 0.5 * (values[half - 1] + values[half]);
}

// Runs both once an iteration and reports the medians over the iterations of
//   ratio, ratio_wall  reference time / our time, of processor and of wall clock: above 1 we are
//                      faster
// The processor's is what a busy machine disturbs least; the wall clock's also sees idle threads.
// The iteration's own time is ours alone.
template <typename Reference, typename Ours>
void run_against(benchmark::State& state, Reference&& reference, Ours&& ours) {
    std::vector<double> cpu_ratios, wall_ratios, reference_times, our_times;
    for (auto _ : state) {
        const Times theirs = timed(reference);
        const Times our = timed(ours);
        state.SetIterationTime(our.wall_s);
        cpu_ratios.push_back(theirs.cpu_s / our.cpu_s);
        wall_ratios.push_back(theirs.wall_s / our.wall_s);
        reference_times.push_back(theirs.cpu_s);
        our_times.push_back(our.cpu_s);
    }
    state.counters["ratio"] = median(cpu_ratios);
    state.counters["ratio_wall"] = median(wall_ratios);
    state.counters["reference_cpu_s"] = median(reference_times);
    state.counters["ours_cpu_s"] = median(our_times);
}

}  // namespace paim::bench
