// Command lines that make no sense: exit code 1, a message that names the option, nothing written.
#include <utility>

#include "tests/cli/tool_test.h"

namespace paim {
namespace {

class Usage : public ToolTest {
  protected:
    void expect_usage_error(const char* tool, const Arguments& arguments,
                            const Arguments& parts) const {
        const Contents before = contents_of(directory_.path());
        expect_failure(run(tool, arguments), 1, parts);
        expect_same(contents_of(directory_.path()), before);
    }
};

TEST_F(Usage, Compress) {
    const std::string poses = make_poses("box", 3, 50);
    expect_usage_error(PAIM_COMPRESS, {}, {"no OBJ files given", "--help"});
    expect_usage_error(PAIM_COMPRESS, {poses}, {"--output is required"});
    expect_usage_error(PAIM_COMPRESS, {poses, "-o", path("x.bake")}, {"--output", ".paim"});
    expect_usage_error(PAIM_COMPRESS, {poses, "-o", path("x.paim"), "--poses", "0-1"},
                       {"unknown option '--poses'"});
    expect_usage_error(PAIM_COMPRESS, {"bake", "-o", path("x.bake")}, {"OBJ is required"});
    expect_usage_error(PAIM_COMPRESS, {"bake", poses}, {"--output is required"});
    expect_usage_error(PAIM_COMPRESS, {"bake", poses, "-o", path("x.paim")},
                       {"--output: expected a directory", "x.bake", "got"});
    expect_usage_error(PAIM_COMPRESS, {"encode", "-o", path("x.paim")}, {"BAKE is required"});

    const std::vector<std::pair<Arguments, Arguments>> bake_cases{
        {{"--rays", "15"}, {"--rays: expected an even number", "got 15"}},
        {{"--rays", "0"}, {"--rays: expected 2 to 16777216, got '0'"}},
        {{"--rays", "many"}, {"--rays", "many"}},
        {{"--noise-target", "0"}, {"--noise-target: expected more than 0", "got '0'"}},
        {{"--noise-target", "3"}, {"--noise-target: expected more than 0", "got '3'"}},
        {{"--transfer-error", "3"}, {"--transfer-error: expected more than 0", "got '3'"}},
        {{"--transfer-error", "2%", "--noise-target", "2%"}, {"former name of --noise-target"}},
        {{"--pose-noise", "per-pose"},
         {"--pose-noise: expected one of independent, shared, mixed, got 'per-pose'"}},
        {{"--pose-noise", "0"}, {"--pose-noise: expected one of", "got '0'"}},
        {{"--streams", "independent"}, {"--streams: expected one of per-pose, shared, mixed"}},
        {{"--bands", "0"}, {"--bands: expected 1 to 64, got '0'"}},
        {{"--bands", "65"}, {"--bands", "65"}},
        {{"--bands", "-1"}, {"--bands", "-1"}},
        {{"--seed", "-1"}, {"--seed", "-1"}},
        {{"--seed", "18446744073709551616"}, {"--seed", "18446744073709551616"}},
        {{"--threads", "-1"}, {"--threads", "-1"}},
        {{"--normals", "smooth"}, {"--normals: expected one of faces, file, got 'smooth'"}},
        {{"--albedo", "1,2,3"}, {"--albedo: expected", "'1,2,3'"}},
        {{"--albedo", "red"}, {"--albedo: expected", "'red'"}},
        {{"--poses", "2-1"}, {"--poses: expected A-B with 0 <= A <= B <= 2, got '2-1'"}},
        {{"--poses", "0-3"}, {"--poses: expected A-B", "'0-3'"}},
        {{"--poses", "-1"}, {"--poses"}},
        {{"--poses", "1-"}, {"--poses: expected A-B", "'1-'"}},
        {{"--poses", "1-2x"}, {"--poses: expected A-B", "'1-2x'"}},
        {{"--poses", "all"}, {"--poses: expected A-B", "'all'"}},
        {{"--geometry-components", "2"}, {"--geometry-components"}},  // of encode
    };
    for (const auto& [options, parts] : bake_cases) {
        Arguments arguments{"bake", poses, "-o", path("x.bake")};
        arguments.insert(arguments.end(), options.begin(), options.end());
        expect_usage_error(PAIM_COMPRESS, arguments, parts);
    }

    const std::string bake = make_bake("y.bake");
    const std::vector<std::pair<Arguments, Arguments>> encode_cases{
        {{"--geometry-components", "-3"},
         {"--geometry-components: expected a number, 'auto' or 'all'", "'-3'"}},
        {{"--transfer-components", "most"}, {"--transfer-components: expected", "'most'"}},
        {{"--transfer-components", "4x"}, {"--transfer-components: expected", "'4x'"}},
        {{"--transfer-components", "99999999999"},
         {"--transfer-components: expected", "99999999999"}},
        {{"--transfer-components", ""}, {"--transfer-components"}},
        {{"--bands", "0"}, {"--bands", "0"}},
        {{"--precision", "i7"}, {"--precision: expected one of auto, f32, f16, got 'i7'"}},
        {{"--codec", "1"}, {"--codec: expected one of auto, svd, cpca, got '1'"}},
        {{"--fps", "0"}, {"--fps", "0"}},
        {{"--fps", "nan"}, {"--fps"}},
        {{"--memory", "63M"}, {"--memory: expected at least 64M, got '63M'"}},
        {{"--memory", "much"}, {"--memory: expected bytes", "'much'"}},
        {{"--rays", "16"}, {"--rays"}},  // of bake
    };
    for (const auto& [options, parts] : encode_cases) {
        Arguments arguments{"encode", bake, "-o", path("x.paim")};
        arguments.insert(arguments.end(), options.begin(), options.end());
        expect_usage_error(PAIM_COMPRESS, arguments, parts);
    }
}

TEST_F(Usage, Info) {
    expect_usage_error(PAIM_INFO, {}, {"FILE is required", "--help"});
    expect_usage_error(PAIM_INFO, {"a.paim", "b.paim"}, {"b.paim"});
}

TEST_F(Usage, Analyze) {
    const std::string bake = make_bake("x.bake");
    expect_usage_error(PAIM_ANALYZE, {"-o", path("out")}, {"BAKE is required"});
    expect_usage_error(PAIM_ANALYZE, {bake}, {"--output is required"});
    expect_usage_error(PAIM_ANALYZE, {bake, "-o", bake}, {"--output", "is a bake"});
    const std::vector<std::pair<Arguments, Arguments>> cases{
        {{"--components", "4,,2"}, {"--components: expected numbers from 0 to", "'4,,2'"}},
        {{"--components", "4,2,"}, {"--components: expected numbers", "'4,2,'"}},
        {{"--components", "-4"}, {"--components"}},
        {{"--bands", "0"}, {"--bands: expected numbers from 1 to", "'0'"}},
        {{"--bands", "two"}, {"--bands: expected numbers", "'two'"}},
        {{"--size", "15"}, {"--size", "15"}},
        {{"--size", "5000"}, {"--size", "5000"}},
        {{"--poses", "0"}, {"--poses", "0"}},
        {{"--elevation", "90"}, {"--elevation", "90"}},
        {{"--azimuth", "nan"}, {"--azimuth"}},
    };
    for (const auto& [options, parts] : cases) {
        Arguments arguments{bake, "-o", path("out")};
        arguments.insert(arguments.end(), options.begin(), options.end());
        expect_usage_error(PAIM_ANALYZE, arguments, parts);
    }
}

}  // namespace
}  // namespace paim
