// A player that runs for days: opening models and drawing frames leaves nothing
// behind.
#include <epoxy/gl.h>
#include <gtest/gtest.h>
#include <malloc.h>
#include <unistd.h>

#include <array>
#include <fstream>
#include <memory>
#include <string>
#include <vector>

#include "paim/codec/sequence_bounds.h"
#include "paim/light/sky.h"
#include "player/gl/check.h"
#include "player/gl/headless_context.h"
#include "player/presenter.h"
#include "tests/player/test_asset.h"

#if defined(__SANITIZE_ADDRESS__)
constexpr bool kSanitized = true; // keeps freed memory for a while
#else
constexpr bool kSanitized = false;
#endif

namespace paim::player {
namespace {

constexpr uint32_t kNumModels = 200, kNumFrames = 10000;

// OpenGL objects that are alive. Drivers give the names of deleted ones again,
// so that live names stay far below the range that is searched: 200 models that
// leak an object each would still be in it.
struct LiveObjects {
  uint32_t textures = 0, buffers = 0, arrays = 0, framebuffers = 0,
           renderbuffers = 0, programs = 0, shaders = 0;

  bool operator==(const LiveObjects &) const = default;
};

LiveObjects live_objects() {
  glUseProgram(
      0); // a program that is deleted lives for as long as it is in use
  constexpr GLuint kMostNames = 20000;
  LiveObjects live;
  for (GLuint name = 1; name < kMostNames; ++name) {
    live.textures += glIsTexture(name);
    live.buffers += glIsBuffer(name);
    live.arrays += glIsVertexArray(name);
    live.framebuffers += glIsFramebuffer(name);
    live.renderbuffers += glIsRenderbuffer(name);
    live.programs += glIsProgram(name);
    live.shaders += glIsShader(name);
  }
  return live;
}

void expect_no_more(const LiveObjects &now, const LiveObjects &before) {
  EXPECT_LE(now.textures, before.textures);
  EXPECT_LE(now.buffers, before.buffers);
  EXPECT_LE(now.arrays, before.arrays);
  EXPECT_LE(now.framebuffers, before.framebuffers);
  EXPECT_LE(now.renderbuffers, before.renderbuffers);
  EXPECT_LE(now.programs, before.programs);
  EXPECT_LE(now.shaders, before.shaders);
}

// That the program has asked for on its main thread's heap and not given back.
int64_t heap_bytes_in_use() {
  const struct mallinfo2 info = ::mallinfo2();
  return static_cast<int64_t>(info.uordblks + info.hblkhd);
}

int64_t resident_bytes() {
  int64_t size = 0, resident = 0;
  std::ifstream("/proc/self/statm") >> size >> resident;
  return resident * ::sysconf(_SC_PAGESIZE);
}

std::shared_ptr<const Asset> model(uint32_t i) {
  TestAssetOptions options;
  options.bands = 2 + i % 4;
  options.channels = i % 3 == 0 ? 3 : 1;
  options.num_rings = 8 + 8 * (i % 3);
  options.num_clusters = i % 2 == 0 ? 0 : 4;
  options.cluster_components = i % 2 == 0 ? 0 : 2;
  Asset asset = make_test_asset(options);
  if (i % 5 == 0) {
    TestAssetOptions still = options;
    still.num_clusters = still.cluster_components = 0;
    asset.parts.push_back(stand_still(make_test_asset(still).moving(), 3.0f));
  }
  return std::make_shared<const Asset>(std::move(asset));
}

// A view that uses something else each time.
ViewState view_of(uint32_t i) {
  ViewState view;
  view.animation.time = 0.13 * (i % 40);
  view.light.orientation.yaw_deg = i;
  view.edges = i % 4 == 0;
  view.num_instances = 1 + i % 3;
  view.comparison = std::array{Comparison::none, Comparison::wipe,
                               Comparison::side_by_side}[i % 3];
  view.background.kind =
      i % 2 == 0 ? Background::Kind::environment : Background::Kind::blurred;
  const std::array surfaces{SurfaceView::lit, SurfaceView::coefficient,
                            SurfaceView::normals, SurfaceView::transfer_error};
  view.surface = surfaces[i / 3 % surfaces.size()];
  view.limits.transfer_components = i % 6;
  return view;
}

class LongRun : public testing::TestWithParam<Decoder> {
protected:
  static Presenter make(const std::shared_ptr<const Asset> &asset) {
    return {asset,
            sequence_bounds(*asset),
            EnvironmentLight(make_sky()),
            {},
            {},
            GetParam()};
  }

  // One frame after the other is waited for. On a busy machine drivers fall
  // behind by a number of frames that differs, and keep as much memory for
  // them.
  static void draw(Presenter &presenter, const ViewState &view,
                   const gl::Target &target) {
    presenter.draw(view, target);
    glFinish();
  }

  std::unique_ptr<gl::Context> context_ = gl::make_headless_context();
};

TEST_P(LongRun, OpensModelsOneAfterTheOther) {
  constexpr uint32_t kCycle = 60; // after which models are the same again
  const std::shared_ptr<const Asset> first = model(0);
  Presenter presenter = make(first);
  const gl::Target target(16, 12);
  LiveObjects live;
  int64_t resident = 0;
  for (uint32_t i = 0; i < kNumModels; ++i) {
    const std::shared_ptr<const Asset> asset = model(i % kCycle);
    presenter.set_asset(asset, sequence_bounds(*asset), {}, {});
    for (uint32_t frame = 0; frame < 3; ++frame)
      draw(presenter, view_of(3 * i + frame), target);
    // Nobody else keeps the model before.
    EXPECT_LE(asset.use_count(), 10);
    if (i + 1 != kCycle && i + 1 != 2 * kCycle && i + 1 != 3 * kCycle)
      continue;
    if (i + 1 == kCycle) {
      live = live_objects();
      EXPECT_GT(live.textures + live.buffers, 4u);
      EXPECT_GT(live.programs, 0u);
      continue;
    }
    expect_no_more(live_objects(), live);
    if (i + 1 == 2 * kCycle)
      resident = resident_bytes();
  }
  gl::check_errors("drawing");
  // The margin is for pages that the allocator keeps.
  if (kSanitized)
    return;
  EXPECT_LE(resident_bytes() - resident, 8'000'000);
}

TEST_P(LongRun, KeepsNothingOfAPresenterThatIsGone) {
  LiveObjects before = live_objects();
  for (uint32_t i = 0; i < 3; ++i) {
    std::weak_ptr<const Asset> kept;
    {
      std::shared_ptr<const Asset> asset = model(i);
      Presenter presenter = make(asset);
      kept = asset;
      asset.reset();
      const gl::Target target(16, 12);
      for (uint32_t frame = 0; frame < 12; ++frame)
        presenter.draw(view_of(frame), target);
    }
    EXPECT_TRUE(kept.expired());
  }
  expect_no_more(live_objects(), before);
}

TEST_P(LongRun, DrawsManyFrames) {
  const std::shared_ptr<const Asset> asset =
      model(GetParam() == Decoder::gpu ? 0 : 5);
  Presenter presenter = make(asset);
  const gl::Target target(8, 6);
  LiveObjects live;
  int64_t resident = 0, in_use = 0;
  for (uint32_t i = 0; i < kNumFrames; ++i) {
    draw(presenter, view_of(i), target);
    if (i % 100 == 0)
      presenter.set_environment(EnvironmentLight(Image(8, 4, Vec3f::Ones())));
    if (i + 1 != kNumFrames / 4)
      continue;
    live = live_objects();
    resident = resident_bytes();
    in_use = heap_bytes_in_use();
  }
  gl::check_errors("drawing");
  expect_no_more(live_objects(), live);
  if (kSanitized)
    return;
  // 140 bytes lost with every frame are found.
  EXPECT_LE(heap_bytes_in_use() - in_use, 1'000'000);
  // What the driver compiles, and pages that the allocator keeps although
  // nothing in them is in use.
  EXPECT_LE(resident_bytes() - resident, 20'000'000);
}

INSTANTIATE_TEST_SUITE_P(Decoders, LongRun,
                         testing::Values(Decoder::gpu, Decoder::cpu),
                         [](const auto &parameter) {
                           return parameter.param == Decoder::gpu ? "Gpu"
                                                                  : "Cpu";
                         });

} // namespace
} // namespace paim::player
