// paim-analyze: error curves of a bake.
#include "analysis/analyze.h"
#include "analysis/options.h"
#include "paim/cli/run_main.h"

int main(int argc, char** argv) {
    return paim::cli::run_main("paim-analyze", [&] {
        int exit_code = 0;
        const auto options = paim::parse_options(argc, argv, exit_code);
        if (options) {
            paim::analyze(*options);
            exit_code = 0;
        }
        return exit_code;
    });
}
