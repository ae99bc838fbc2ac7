// What becomes of the view, the picked vertex and its history when more of a file arrives, or another file
// takes its place.
#include "player/session.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <thread>

#include "paim/base/error.h"
#include "player/gl/headless_context.h"
#include "player/ui/inspector.h"
#include "tests/player/prefix_file.h"
#include "tests/player/test_asset.h"
#include "tests/temporary_directory.h"

namespace paim::player {
namespace {

constexpr float kAspect = 1.5f;
constexpr std::chrono::minutes kHung(5);  // only a test that fails takes so long

class SessionTest : public testing::Test {
  protected:
    // With as much of the file as there is.
    void start() {
        options_.model_path = path_;
        options_.play_prefix = true;
        auto loader = start_loading(path_, true);
        Scene scene = make_scene(options_, loader->wait_for_first([] {}));
        session_.emplace(options_, std::move(scene), std::move(loader), kAspect);
    }

    // Lets the session take what comes until the condition holds. Returns what it said.
    template <typename Condition>
    std::string take_until(const Condition& holds) {
        std::string said;
        const auto hung = std::chrono::steady_clock::now() + kHung;
        while (!holds()) {
            if (std::chrono::steady_clock::now() > hung) throw std::runtime_error("nothing came");
            std::string message;
            session_->read_on();
            session_->take_more(kAspect, message);
            said += message;
            // Lets the loader have the lock.
            std::this_thread::sleep_for(std::chrono::milliseconds(1));
        }
        return said;
    }

    void measure_history() {
        while (inspector_.advance(*session_)) {
        }
    }

    // Its own, computed again.
    std::vector<float> expected_history() {
        const ViewState& view = session_->view;
        ErrorHistory history(session_->presenter().shared_asset(), *view.picked,
                             SurfaceView::transfer_error, view.limits,
                             session_->presenter().light_of(view));
        while (!history.values().advance(size_t{1})) {
        }
        const auto values = history.values().values();
        return {values.begin(), values.end()};
    }

    std::vector<float> shown_history() {
        PanelInfo info;
        inspector_.describe(*session_, {}, kAspect, info);
        return {info.picked->history.begin(), info.picked->history.end()};
    }

    std::unique_ptr<gl::Context> context_ = gl::make_headless_context();
    TemporaryDirectory directory_;
    std::filesystem::path path_ = directory_ / "ball.paim";
    Options options_;
    std::optional<Session> session_;
    Inspector inspector_;
};

TEST_F(SessionTest, HistoriesAreOfTheDetailThatIsThere) {
    PrefixFile file(path_, make_test_asset({}));
    const auto some = std::find_if(file.prefixes.begin(), file.prefixes.end(),
                                   [](const Prefix& p) { return p.transfer_components == 3; });
    ASSERT_NE(some, file.prefixes.end());
    file.write_up_to(some->size_bytes);
    start();
    session_->view.limits.transfer_components = 1;
    session_->view.picked = PickedVertex{0, 17};
    measure_history();
    const std::vector<float> before = shown_history();
    EXPECT_EQ(before, expected_history());
    file.write_up_to(file.bytes.size());
    take_until([&] { return session_->asset().complete; });
    // What was lowered stays, and so does the vertex; its error against more detail is larger.
    EXPECT_EQ(session_->view.limits.transfer_components, 1u);
    ASSERT_EQ(session_->view.picked, (PickedVertex{0, 17}));
    measure_history();
    EXPECT_EQ(shown_history(), expected_history());
    EXPECT_NE(shown_history(), before);
}

TEST_F(SessionTest, AVertexOfAnotherModelIsNotPickedAnyMore) {
    PrefixFile file(path_, make_test_asset({}));
    file.write_up_to(file.prefixes[5].size_bytes);  // more may come
    start();
    session_->view.picked = PickedVertex{0, session_->asset().moving().topology.num_vertices - 1};
    measure_history();
    TestAssetOptions options;
    options.num_rings = 3;  // fewer vertices
    options.bands = 3;
    options.num_poses = 2;
    options.geometry_components = options.transfer_components = 2;
    std::filesystem::remove(path_);
    PrefixFile smaller(path_, make_test_asset(options));
    smaller.write_up_to(smaller.bytes.size());
    take_until([&] { return session_->asset().num_poses() == 2; });
    EXPECT_FALSE(session_->view.picked);
    measure_history();
    PanelInfo info;
    inspector_.describe(*session_, {}, kAspect, info);
    EXPECT_FALSE(info.picked);
    EXPECT_LE(session_->view.limits.bands, 3u);
}

TEST_F(SessionTest, AnOpenedModelStartsAtItsFirstPoseWithAllItHas) {
    PrefixFile file(path_, make_test_asset({}));
    file.write_up_to(file.bytes.size());
    start();
    session_->view.limits = {1, 1, 1, 0};
    session_->view.animation.time = 3.0;
    session_->view.picked = PickedVertex{0, 1};
    TestAssetOptions options;
    options.num_clusters = 5;
    options.cluster_components = 3;
    const std::filesystem::path other = directory_ / "other.paim";
    write_paim(other, make_test_asset(options));
    EXPECT_EQ(session_->open(other, kAspect), "model: other.paim");
    EXPECT_EQ(session_->view.limits, session_->range().limits);
    EXPECT_EQ(session_->view.animation.time, 0.0);
    EXPECT_FALSE(session_->view.picked);
    EXPECT_EQ(session_->model_path(), other);
}

// More than a window shows first, with damage beyond that.
TEST_F(SessionTest, WhatWasReadOfADamagedModelStays) {
    PrefixFile file(path_, make_test_asset({}));
    file.write_up_to(file.bytes.size());
    start();
    TestAssetOptions options;
    options.bands = 8;
    options.num_rings = 70;
    options.num_poses = 12;
    options.transfer_components = 10;
    const std::filesystem::path other = directory_ / "other.paim";
    write_paim(other, make_test_asset(options));
    ASSERT_GT(std::filesystem::file_size(other), LoaderPace::kFirstBytes);
    {
        std::fstream bytes(other, std::ios::binary | std::ios::in | std::ios::out);
        bytes.seekp(-64, std::ios::end);
        bytes.write("damage", 6);
    }
    EXPECT_EQ(session_->open(other, kAspect), "model: other.paim");
    EXPECT_FALSE(session_->asset().complete);
    std::string said;
    said = take_until([&] { return session_->loading().empty(); });
    EXPECT_NE(said.find("other.paim"), std::string::npos) << said;
    EXPECT_FALSE(session_->asset().complete);
    EXPECT_EQ(session_->asset().num_poses(), 12u);
}

}  // namespace
}  // namespace paim::player
