// Runs the benchmarks, with loops on all cores as in the tools.
#include <benchmark/benchmark.h>

#include "paim/base/tbb_parallel.h"

int main(int argc, char** argv) {
    paim::use_tbb();
    benchmark::Initialize(&argc, argv);
    if (benchmark::ReportUnrecognizedArguments(argc, argv)) return 1;
    benchmark::RunSpecifiedBenchmarks();
    benchmark::Shutdown();
}
