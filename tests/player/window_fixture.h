// A window on a virtual screen with somebody before it, for one test.
#pragma once

#include <gtest/gtest.h>

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "player/app.h"
#include "tests/player/test_asset.h"
#include "tests/player/x_server.h"
#include "tests/player/x_user.h"
#include "tests/temporary_directory.h"

namespace paim::player {

using DisplayValue = std::array<uint8_t, 3>;

// The largest difference of any display value; 255 if the sizes differ.
int largest_difference(const ScreenPicture& a, const ScreenPicture& b);
// Columns first … last − 1.
ScreenPicture columns(const ScreenPicture& picture, int first, int last);

// Display values of the GPU's tone curve, which may round another way than the CPU's.
constexpr int kRounding = 1;

class WindowTest : public testing::Test {
  protected:
    // The test's current folder, and the user's home, are an empty one.
    WindowTest();
    // Fails if OpenGL has complained.
    ~WindowTest() override;

    // Opens the window on model.paim of this asset, under a yellow and a blue light, in place
    // of the window that is open. The background is kBackdrop. 400 x 300 pixels unless the arguments
    // say otherwise.
    void play(const Asset& asset, std::vector<std::string> arguments = {});
    // The same, paused at pose 0 under a light that rests, without panels.
    void show(const Asset& asset, const std::vector<std::string>& arguments = {});

    App& app() { return *app_; }
    XUser& user() { return *user_; }
    // OpenGL's, so far.
    std::vector<std::string>& complaints() { return complaints_; }
    ViewState& view() { return app_->session().view; }
    Presenter& presenter() { return app_->session().presenter(); }

    // Steps until nothing is redrawn.
    void settle();
    void step(int count);
    // Whether the condition holds after some step. Gives up when the window has come to rest.
    template <typename Condition>
    bool step_until(const Condition& condition) {
        constexpr int kMost = 20000, kMostIdle = 50;
        for (int i = 0, num_idle = 0; i < kMost && num_idle < kMostIdle; ++i) {
            if (condition()) return true;
            num_idle += app_->step() ? 0 : 1;
        }
        return false;
    }
    // A key, and all that follows, of a window that is paused.
    void press(const char* key, bool shift = false);
    void move(int x, int y);
    void click(int x, int y);
    // Presses a button in one place and releases it in another.
    void drag(std::pair<int, int> from, std::pair<int, int> to, int button = 1);
    // As a file manager drops them. Returns what the window says to that.
    std::string drop(const std::vector<std::string>& paths);

    ScreenPicture screen() { return user_->look(); }
    // What the window should show without panels: the picture of the presenter.
    ScreenPicture picture_of(const ViewState& shown);

    // Where a piece of a panel is that answers to the pointer, found by the pointer.
    // returns  how far it reaches to the left and to the right in one of its rows
    struct Widget {
        int left, right, y;
    };
    std::optional<Widget> find_widget(const char* panel, const char* label);
    // The words of the panel that is drawn first.
    std::string words();

    // x and y of a vertex in the window, pixels.
    std::pair<double, double> place_of(const PickedVertex& vertex);

    static constexpr DisplayValue kBackdrop{0, 0, 255};
    TemporaryDirectory directory_;

  private:
    std::filesystem::path old_folder_ = std::filesystem::current_path();
    XServer server_{PAIM_XVFB};
    Options options_;
    std::vector<std::string> complaints_;
    std::unique_ptr<App> app_;
    std::optional<XUser> user_;
};

}  // namespace paim::player
