// The window under test.
#include "tests/player/window_fixture.h"

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>
#include <imgui_internal.h>
#include <stdlib.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>

#include "paim/format/paim/paim_write.h"
#include "paim/image/exr.h"
#include "paim/light/environment.h"
#include "player/gl/check.h"
#include "player/view/framing.h"

namespace paim::player {

namespace {

// Two lights, a yellow one above and a blue one at the side, so dim that nothing is white.
Image make_light() {
    Image light(32, 16);
    for (int y = 0; y < light.height; ++y) {
        for (int x = 0; x < light.width; ++x) {
            const Vec3d direction = direction_from_latlong((x + 0.5) / 32.0, (y + 0.5) / 16.0);
            const double above = std::pow(std::max(0.0, direction.y()), 4.0);
            const double from_right = std::pow(std::max(0.0, direction.x()), 4.0);
            light.at(x, y) = Vec3d(0.01 + 0.4 * above, 0.01 + 0.4 * above + 0.1 * from_right,
                                   0.01 + 0.05 * above + 0.8 * from_right)
                                 .cast<float>();
        }
    }
    return light;
}

std::string clipboard;

}  // namespace

int largest_difference(const ScreenPicture& a, const ScreenPicture& b) {
    if (a.width != b.width || a.height != b.height) return 255;
    int largest = 0;
    for (size_t i = 0; i < a.pixels.size(); ++i) {
        for (size_t c = 0; c < 3; ++c) {
            largest = std::max(largest, std::abs(int{a.pixels[i][c]} - int{b.pixels[i][c]}));
        }
    }
    return largest;
}

ScreenPicture columns(const ScreenPicture& picture, int first, int last) {
    ScreenPicture part{last - first, picture.height, {}};
    for (int y = 0; y < picture.height; ++y) {
        for (int x = first; x < last; ++x) part.pixels.push_back(picture.at(x, y));
    }
    return part;
}

WindowTest::WindowTest() {
    ::unsetenv("WAYLAND_DISPLAY");
    ::setenv("XDG_STATE_HOME", (directory_ / "state").c_str(), 1);
    std::filesystem::create_directory(directory_ / "folder");
    std::filesystem::current_path(directory_ / "folder");
    write_exr(directory_ / "light.exr", make_light());
}

WindowTest::~WindowTest() {
    user_.reset();
    app_.reset();
    std::filesystem::current_path(old_folder_);
    for (const std::string& complaint : complaints_) ADD_FAILURE() << "OpenGL: " << complaint;
}

void WindowTest::play(const Asset& asset, std::vector<std::string> arguments) {
    const std::string model = directory_ / "model.paim", light = directory_ / "light.exr";
    write_paim(model, asset);
    if (std::find(arguments.begin(), arguments.end(), "--size") == arguments.end()) {
        arguments.insert(arguments.end(), {"--size", "400x300"});
    }
    arguments.insert(arguments.begin(),
                     {"paim-play", model, "--env", light, "--background", "0,0,1"});
    std::vector<const char*> words;
    for (const std::string& argument : arguments) words.push_back(argument.c_str());
    user_.reset();
    app_.reset();
    options_ = Options();
    ASSERT_EQ(parse_options(static_cast<int>(words.size()), words.data(), options_), -1);
    // Hints of before hold for the window that App makes.
    if (glfwInit() == GLFW_TRUE) glfwWindowHint(GLFW_OPENGL_DEBUG_CONTEXT, GLFW_TRUE);
    app_ = std::make_unique<App>(options_, load_scene(options_), nullptr);
    gl::report_driver_messages(
        [this](std::string_view message) { complaints_.emplace_back(message); });
    user_.emplace(app_->window().handle());
    user_->move_to(1, 1);
}

void WindowTest::show(const Asset& asset, const std::vector<std::string>& arguments) {
    ASSERT_NO_FATAL_FAILURE(play(asset, arguments));
    for (const char* key : {"Home", "l", "Tab"}) user_->press(key);
    settle();
    ASSERT_FALSE(view().animation.playing);
    ASSERT_FALSE(app().panels().show_panels);
}

void WindowTest::settle() {
    constexpr int kMost = 200;
    for (int i = 0; i < kMost; ++i) {
        if (!app_->step()) return;
    }
    FAIL() << "the window is redrawn for ever";
}

void WindowTest::step(int count) {
    for (int i = 0; i < count; ++i) app_->step();
}

void WindowTest::press(const char* key, bool shift) {
    user_->press(key, shift);
    settle();
}

void WindowTest::move(int x, int y) {
    user_->move_to(x, y);
    step(2);  // panels see the pointer one frame later
}

void WindowTest::click(int x, int y) {
    drag({x, y}, {x, y});
}

void WindowTest::drag(std::pair<int, int> from, std::pair<int, int> to, int button) {
    move(from.first, from.second);
    user_->button(button, true);
    step(2);
    move(to.first, to.second);
    user_->button(button, false);
    step(2);
}

std::string WindowTest::drop(const std::vector<std::string>& paths) {
    std::vector<const char*> names;
    for (const std::string& path : paths) names.push_back(path.c_str());
    GLFWwindow* const window = app().window().handle();
    const GLFWdropfun on_drop = glfwSetDropCallback(window, nullptr);
    glfwSetDropCallback(window, on_drop);
    on_drop(window, static_cast<int>(names.size()), names.data());
    const std::string message = app().message();
    settle();
    return message;
}

ScreenPicture WindowTest::picture_of(const ViewState& shown) {
    const auto [width, height] = app().window().framebuffer_size();
    const Image image = presenter().render(shown, width, height, options_.window_samples());
    return {width, height, tone_map(image, Presenter::tone_curve(shown))};
}

std::optional<WindowTest::Widget> WindowTest::find_widget(const char* panel, const char* label) {
    constexpr int kInside = 16, kAcross = 24, kDown = 6;
    ImGuiWindow* const window = ImGui::FindWindowByName(panel);
    if (window == nullptr) return std::nullopt;
    const ImGuiID id = window->GetID(label);
    const auto is_at = [&](int x, int y) {
        move(x, y);
        return ImGui::GetHoveredID() == id;
    };
    // Halves the way from a place of the widget to one beyond it.
    const auto edge = [&](int within, int beyond, int y) {
        while (std::abs(beyond - within) > 1) {
            const int middle = (within + beyond) / 2;
            (is_at(middle, y) ? within : beyond) = middle;
        }
        return within;
    };
    const ImRect area = window->Rect();
    const int left = static_cast<int>(area.Min.x), right = static_cast<int>(area.Max.x);
    const int top = static_cast<int>(area.Min.y), bottom = static_cast<int>(area.Max.y);
    for (int x = left + kInside; x < right; x += kAcross) {
        for (int y = top + kDown; y < bottom; y += kDown) {
            if (is_at(x, y)) return Widget{edge(x, left, y), edge(x, right, y), y};
        }
    }
    return std::nullopt;
}

std::string WindowTest::words() {
    clipboard.clear();
    ImGuiContext& context = *ImGui::GetCurrentContext();
    context.IO.SetClipboardTextFn = [](void*, const char* text) { clipboard = text; };
    ImGuiContextHook hook;
    hook.Type = ImGuiContextHookType_NewFramePost;
    hook.Callback = [](ImGuiContext* current, ImGuiContextHook*) {
        if (!current->LogEnabled) ImGui::LogToClipboard();
    };
    const ImGuiID id = ImGui::AddContextHook(&context, &hook);
    user_->move_to(2, 2);  // so that the window is drawn again
    user_->move_to(1, 1);
    app_->step();
    ImGui::RemoveContextHook(&context, id);
    return clipboard;
}

std::pair<double, double> WindowTest::place_of(const PickedVertex& vertex) {
    const auto [width, height] = app().window().framebuffer_size();
    const std::optional<Vec3f> place =
        project(presenter().camera(view()), static_cast<float>(width) / static_cast<float>(height),
                presenter().probe().position(presenter().time(view()), view().limits, vertex));
    if (!place) return {-1.0, -1.0};
    return {double{place->x()} * width, double{place->y()} * height};
}

}  // namespace paim::player
