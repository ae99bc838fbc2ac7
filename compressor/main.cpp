// paim-compress: OBJ pose sequences become .bake directories and .paim files.
#include "compressor/command_line.h"
#include "compressor/pipeline.h"
#include "paim/cli/run_main.h"

int main(int argc, char** argv) {
    return paim::cli::run_main("paim-compress", [&] {
        int exit_code = 0;
        const auto options = paim::parse_options(argc, argv, exit_code);
        if (options) {
            paim::run(*options);
            exit_code = 0;
        }
        return exit_code;
    });
}
