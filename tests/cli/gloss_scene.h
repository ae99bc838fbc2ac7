// A glossy body that travels and turns, on a floor, next to a glossy mesh that stands still, in light that
// bounces; made by the tools.
#pragma once

#include <fmt/format.h>

#include <cmath>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "paim/codec/playback.h"
#include "paim/format/paim/paim_read.h"
#include "tests/cli/gloss_tool.h"

namespace paim {

constexpr uint32_t kScenePoses = 4;
constexpr int kSceneBands = 3, kSceneOutBands = 3;

// Where a body is in pose p.
struct Place {
    explicit Place(uint32_t p)
        : turn(Eigen::AngleAxisd(0.7 * p, Vec3d(0.2, 1.0, 0.1).normalized())),
          shift(1.5 * p, 0.1 * p, -0.4 * p) {}
    Vec3d operator()(const Vec3d& x) const { return turn * x + shift; }

    Eigen::Matrix3d turn;
    Vec3d shift;
};

class GlossScene : public GlossTool {
  protected:
    // An octopus of 1000 vertices: `walk` moves and travels, `rigid` travels alone.
    void SetUp() override {
        make_poses("octopus", kScenePoses, 1000);
        for (const char* const folder : {"walk", "rigid"}) {
            std::filesystem::create_directory(directory_ / folder);
        }
        for (uint32_t p = 0; p < kScenePoses; ++p) {
            write(fmt::format("walk/{}.obj", p),
                  moved_obj(text_of(fmt::format("octopus/octopus_{:04}.obj", p)), Place(p)));
            write(fmt::format("rigid/{}.obj", p),
                  moved_obj(text_of("octopus/octopus_0000.obj"), Place(p)));
        }
        write_shiny_sphere("shiny", Vec3d(4.0, 1.0, -3.5));
    }

    void bake_body(const std::string& poses, const std::string& name,
                   const Arguments& more = {}) const {
        Arguments options{"bake",
                          path(poses),
                          "-o",
                          path(name),
                          "--bands",
                          std::to_string(kSceneBands),
                          "--rays",
                          "128",
                          "--bounces",
                          "1",
                          "--material",
                          "phong:0.5,4",
                          "--gloss-bands",
                          fmt::format("{},{}", kSceneBands, kSceneOutBands),
                          "--quiet"};
        options.insert(options.end(), more.begin(), more.end());
        expect_success(compress(options));
    }
    void bake_all(const std::string& name, const std::string& root_motion = "rigid") const {
        bake_body("walk", name,
                  {"--root-motion", root_motion, "--floor", "--floor-vertices", "300", "--static",
                   path("shiny.obj"), "--gloss"});
    }

    // All that the bake has, as floats.
    void encode_whole(const std::string& bake, const std::string& name) const {
        encode(bake, name, {"--geometry-components", "all", "--transfer-components", "all"});
    }

    // With outgoing coefficients.
    Playback play(const std::string& file) const {
        Playback playback(std::make_shared<const Asset>(read_paim(path(file))));
        playback.keep_exit_radiance(true);
        return playback;
    }
};

// Σ(a − b)² and Σ b², of several lists.
struct Squares {
    double difference = 0.0, all = 0.0;

    void add(std::span<const Vec3f> a, std::span<const Vec3f> b) {
        ASSERT_EQ(a.size(), b.size());
        for (size_t j = 0; j < a.size(); ++j) {
            difference += static_cast<double>((a[j] - b[j]).squaredNorm());
            all += static_cast<double>(b[j].squaredNorm());
        }
    }
    double relative() const { return std::sqrt(difference / all); }
};

}  // namespace paim
