// paim-analyze: error curves of a bake, and checks of the errors that a .paim states.
#include "analysis/analyze.h"
#include "analysis/compare_alone.h"
#include "analysis/options.h"
#include "analysis/verify.h"
#include "paim/cli/run_main.h"

int main(int argc, char** argv) {
    return paim::cli::run_main("paim-analyze", [&] {
        int exit_code = 0;
        const auto options = paim::parse_options(argc, argv, exit_code);
        if (options) {
            if (!options->verify.empty()) {
                paim::verify(*options);
            } else if (options->bake_directory.empty()) {
                paim::compare_alone(*options);
            } else {
                paim::analyze(*options);
            }
            exit_code = 0;
        }
        return exit_code;
    });
}
