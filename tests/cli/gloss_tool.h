// Bakes and files with gloss, made by the tools.
#pragma once

#include <fmt/format.h>

#include <cstdio>
#include <functional>
#include <sstream>
#include <string>

#include "paim/base/vector.h"
#include "tests/cli/tool_test.h"

namespace paim {

// The text of an OBJ file whose vertices are moved.
inline std::string moved_obj(const std::string& obj,
                             const std::function<Vec3d(const Vec3d&)>& move) {
    std::istringstream lines(obj);
    std::string text;
    for (std::string line; std::getline(lines, line);) {
        Vec3d x;
        int length = 0;
        if (std::sscanf(line.c_str(), "v %lf %lf %lf%n", &x[0], &x[1], &x[2], &length) == 3) {
            x = move(x);
            // Colours stay.
            line = fmt::format("v {:.9g} {:.9g} {:.9g}", x[0], x[1], x[2]) +
                   line.substr(static_cast<size_t>(length));
        }
        text += line + "\n";
    }
    return text;
}

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

    // A sphere of radius 1, whose material library NAME.mtl gives it a tinted Phong lobe.
    void write_shiny_sphere(const std::string& name, const Vec3d& centre) const {
        const std::string folder = name + "-poses";
        expect_success(
            run(PAIM_POSES, {"sphere", "-o", path(folder), "--poses", "1", "--vertices", "200"}));
        write(name + ".obj", "mtllib " + name + ".mtl\nusemtl shiny\n" +
                                 moved_obj(text_of(folder + "/sphere_0000.obj"),
                                           [&](const Vec3d& x) { return Vec3d(x + centre); }));
        write(name + ".mtl", "newmtl shiny\nKd 0.2 0.2 0.2\nKs 0.6 0.3 0.15\nNs 6\n");
    }
};

}  // namespace paim
