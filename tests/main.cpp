// Runs the tests of an executable, with loops on all cores as in the tools.
#include <gtest/gtest.h>

#include "paim/base/tbb_parallel.h"

int main(int argc, char** argv) {
    paim::use_tbb();
    testing::InitGoogleTest(&argc, argv);
    return RUN_ALL_TESTS();
}
