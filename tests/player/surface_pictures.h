// Pictures of surfaces in every context and by both decoders, for comparisons with the CPU.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <memory>
#include <string>
#include <string_view>

#include "paim/codec/sequence_bounds.h"
#include "paim/image/tone.h"
#include "player/gl/check.h"
#include "player/gl/headless_context.h"
#include "player/presenter.h"

namespace paim::player {

// In which context, and who decodes.
struct Way {
    const char* name;
    gl::Api api;
    Decoder decoder;
};

inline auto all_ways() {
    return testing::Values(Way{"Desktop", gl::Api::desktop, Decoder::gpu},
                           Way{"Es", gl::Api::es, Decoder::gpu},
                           Way{"Cpu", gl::Api::desktop, Decoder::cpu});
}

// Fails on every message of the driver.
class SurfacePictures : public testing::TestWithParam<Way> {
  protected:
    SurfacePictures() : context_(gl::make_headless_context(GetParam().api)) {
        gl::report_driver_messages([this](std::string_view message) { messages_ += message; });
    }
    ~SurfacePictures() override {
        EXPECT_EQ(messages_, "");
        gl::check_errors("testing");
    }
    // Under a sky of one bright place.
    Presenter present(const Asset& asset) const {
        const auto shared = std::make_shared<const Asset>(asset);
        Image sky(8, 4, Vec3f(0.1f, 0.09f, 0.08f));
        sky.at(2, 1) = Vec3f(0.9f, 0.6f, 0.2f);
        return {shared, sequence_bounds(*shared), EnvironmentLight(sky), {},
                {},     GetParam().decoder};
    }

    std::string messages_;
    std::unique_ptr<gl::Context> context_;
};

// Numbers of pixels that a body covers in one of two pictures.
struct ShownPixels {
    size_t covered = 0;
    size_t off = 0;     // whose display values differ by more than two steps
    size_t bright = 0;  // above white in the expected one
};

inline ShownPixels compare_shown(const Image& expected, const Image& drawn) {
    const ToneCurve curve;
    ShownPixels pixels;
    for (size_t i = 0; i < expected.pixels.size(); ++i) {
        const Vec3f &a = expected.pixels[i], &b = drawn.pixels[i];
        if (a.isZero(0.0f) && b.isZero(0.0f)) continue;
        ++pixels.covered;
        int largest = 0;
        for (int channel = 0; channel < 3; ++channel) {
            largest =
                std::max(largest, std::abs(curve.apply(a[channel]) - curve.apply(b[channel])));
        }
        pixels.off += largest > 2 ? 1 : 0;
        pixels.bright += a.maxCoeff() > 1.0f ? 1 : 0;
    }
    return pixels;
}

}  // namespace paim::player
