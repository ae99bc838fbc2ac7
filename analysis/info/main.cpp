// paim-info: describes a .paim file or a .bake directory.
#include <fmt/format.h>

#include "analysis/info/describe.h"
#include "analysis/info/prefix_table.h"
#include "paim/base/json_text.h"
#include "paim/cli/parse.h"
#include "paim/cli/run_main.h"

int main(int argc, char** argv) {
    return paim::cli::run_main("paim-info", [&] {
        std::filesystem::path path;
        bool json = false, prefixes = false;
        CLI::App app("Checks a .paim file or a .bake directory and says what it holds.",
                     "paim-info");
        app.set_version_flag("--version", paim::cli::version_text("paim-info"));
        app.footer("Exit codes: 0 ok, 1 usage, 2 missing or damaged, 3 unsupported.");
        app.add_option("FILE", path, "A .paim file or a .bake directory")->required();
        app.add_flag("--prefixes", prefixes,
                     "List what can be played of a .paim before it is read whole: bytes, "
                     "components and errors");
        app.add_flag("--json", json, "Write one JSON object on stdout and nothing else");
        const int exit_code = paim::cli::parse(app, argc, argv);
        if (exit_code >= 0) return exit_code;
        const auto description = prefixes ? paim::describe_prefixes(path) : paim::describe(path);
        using nlohmann::ordered_json;
        fmt::print("{}", json       ? paim::json_text(description, 2) + "\n"
                         : prefixes ? paim::prefixes_as_text(description)
                                    : paim::as_text(description));
        return 0;
    });
}
