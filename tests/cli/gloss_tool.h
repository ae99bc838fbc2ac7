// Bakes and files with gloss, made by the tools.
#pragma once

#include <string>

#include "tests/cli/tool_test.h"

namespace paim {

class GlossTool : public ToolTest {
  protected:
    void SetUp() override {
        expect_success(run(PAIM_POSES, {"sphere", "-o", path("p"), "--poses", "3", "--vertices",
                                        "200", "--json"}));
    }

    ToolResult bake(const std::string& name, const Arguments& options = {}) const {
        Arguments arguments{"bake", path("p"), "-o", path(name), "--rays",
                            "64",   "--bands", "3",  "--quiet"};
        arguments.insert(arguments.end(), options.begin(), options.end());
        return compress(arguments);
    }
    void bake_glossy(const std::string& name) const {
        expect_success(bake(name, {"--material", "phong:0.5,4", "--gloss-bands", "3,2"}));
    }
    nlohmann::json encode(const std::string& bake, const std::string& name,
                          const Arguments& options = {}) const {
        Arguments arguments{"encode", path(bake), "-o", path(name), "--json"};
        arguments.insert(arguments.end(), options.begin(), options.end());
        return parse_object(compress(arguments));
    }
    uint64_t size_of(const std::string& name) const {
        return std::filesystem::file_size(path(name));
    }
};

}  // namespace paim
