// GLFW. Its callbacks find the window through the user pointer.
#include "player/gl/window.h"

#include <epoxy/gl.h>
#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "paim/base/error.h"

namespace paim::player::gl {

namespace {

std::string last_failure() {
    const char* text = nullptr;
    glfwGetError(&text);
    return text != nullptr ? text : "unknown reason";
}

}  // namespace

Window::Library::Library() {
    if (glfwInit() == GLFW_TRUE) return;
    throw_unsupported("no window can be opened ({}); --snapshot OUT.png draws without a display",
                      last_failure());
}

Window::Library::~Library() {
    glfwTerminate();
}

Window::Window(int width, int height, const std::string& title) {
    open(width, height, title);
    glfwMakeContextCurrent(window_);
    require_version();
    glfwSwapInterval(1);
    install_callbacks();
    install_mouse_callbacks();
}

void Window::open(int width, int height, const std::string& title) {
    // The picture has its own depth buffer.
    glfwWindowHint(GLFW_DEPTH_BITS, 0);
    glfwWindowHint(GLFW_STENCIL_BITS, 0);
    glfwWindowHint(GLFW_CONTEXT_VERSION_MAJOR, 3);
    glfwWindowHint(GLFW_CONTEXT_VERSION_MINOR, 3);
    glfwWindowHint(GLFW_OPENGL_PROFILE, GLFW_OPENGL_CORE_PROFILE);
    glfwWindowHint(GLFW_OPENGL_FORWARD_COMPAT, GLFW_TRUE);
    window_ = glfwCreateWindow(width, height, title.c_str(), nullptr, nullptr);
    if (window_ != nullptr) return;
    const std::string desktop_failure = last_failure();
    glfwWindowHint(GLFW_CLIENT_API, GLFW_OPENGL_ES_API);
    glfwWindowHint(GLFW_CONTEXT_CREATION_API, GLFW_EGL_CONTEXT_API);
    glfwWindowHint(GLFW_CONTEXT_VERSION_MINOR, 0);
    glfwWindowHint(GLFW_OPENGL_PROFILE, GLFW_OPENGL_ANY_PROFILE);
    glfwWindowHint(GLFW_OPENGL_FORWARD_COMPAT, GLFW_FALSE);
    window_ = glfwCreateWindow(width, height, title.c_str(), nullptr, nullptr);
    if (window_ != nullptr) return;
    throw_unsupported(
        "no window with OpenGL 3.3 ({}) or OpenGL ES 3.0 ({}) can be opened; --snapshot OUT.png "
        "draws without one",
        desktop_failure, last_failure());
}

Window::~Window() {
    if (window_ != nullptr) glfwDestroyWindow(window_);
}

Window& Window::of(GLFWwindow* window) {
    return *static_cast<Window*>(glfwGetWindowUserPointer(window));
}

void Window::install_callbacks() {
    glfwSetWindowUserPointer(window_, this);
    glfwSetKeyCallback(window_, [](GLFWwindow* window, int key, int, int action, int modifiers) {
        of(window).tell();
        const auto& on_key = of(window).events_.on_key;
        if (action == GLFW_RELEASE || !on_key) return;
        on_key(key, (modifiers & GLFW_MOD_SHIFT) != 0, action == GLFW_REPEAT);
    });
    glfwSetDropCallback(window_, [](GLFWwindow* window, int count, const char** names) {
        of(window).tell();
        const auto& on_drop = of(window).events_.on_drop;
        if (on_drop) on_drop(std::vector<std::filesystem::path>(names, names + count));
    });
    glfwSetCharCallback(window_, [](GLFWwindow* window, unsigned) { of(window).tell(); });
    glfwSetWindowRefreshCallback(window_, [](GLFWwindow* window) { of(window).tell(); });
    glfwSetFramebufferSizeCallback(window_,
                                   [](GLFWwindow* window, int, int) { of(window).tell(); });
}

void Window::install_mouse_callbacks() {
    glfwGetCursorPos(window_, &cursor_x_, &cursor_y_);
    glfwSetCursorPosCallback(
        window_, [](GLFWwindow* window, double x, double y) { of(window).on_cursor(x, y); });
    glfwSetMouseButtonCallback(window_, [](GLFWwindow* window, int button, int action, int) {
        of(window).tell();
        if (button == GLFW_MOUSE_BUTTON_LEFT) of(window).on_left_button(action == GLFW_PRESS);
    });
    glfwSetScrollCallback(window_, [](GLFWwindow* window, double, double steps) {
        of(window).tell();
        const auto& on_scroll = of(window).events_.on_scroll;
        if (on_scroll) on_scroll(steps);
    });
}

void Window::tell() const {
    if (events_.on_any) events_.on_any();
}

bool Window::is_pressed(int glfw_key) const {
    return glfwGetKey(window_, glfw_key) == GLFW_PRESS;
}

void Window::on_cursor(double x, double y) {
    tell();
    const double dx = x - std::exchange(cursor_x_, x);
    const double dy = y - std::exchange(cursor_y_, y);
    const bool ctrl = is_pressed(GLFW_KEY_LEFT_CONTROL) || is_pressed(GLFW_KEY_RIGHT_CONTROL);
    constexpr std::pair<int, MouseButton> kButtons[] = {
        {GLFW_MOUSE_BUTTON_LEFT, MouseButton::left},
        {GLFW_MOUSE_BUTTON_RIGHT, MouseButton::right},
        {GLFW_MOUSE_BUTTON_MIDDLE, MouseButton::middle}};
    for (const auto& [glfw_button, button] : kButtons) {
        if (glfwGetMouseButton(window_, glfw_button) == GLFW_PRESS && events_.on_drag) {
            events_.on_drag(button, ctrl, dx, dy);
            return;
        }
    }
}

void Window::on_left_button(bool pressed) {
    constexpr double kMostMovement = 3.0;  // screen coordinates
    if (pressed) {
        pressed_x_ = cursor_x_;
        pressed_y_ = cursor_y_;
        return;
    }
    const bool moved = std::abs(cursor_x_ - pressed_x_) > kMostMovement ||
                       std::abs(cursor_y_ - pressed_y_) > kMostMovement;
    if (moved || !events_.on_click) return;
    int width = 0, height = 0;
    glfwGetWindowSize(window_, &width, &height);
    events_.on_click(cursor_x_ / std::max(1, width), cursor_y_ / std::max(1, height));
}

void Window::set_title(const std::string& title) {
    glfwSetWindowTitle(window_, title.c_str());
}

bool Window::is_full_screen() const {
    return glfwGetWindowMonitor(window_) != nullptr;
}

void Window::set_full_screen(bool full) {
    if (full == is_full_screen()) return;
    if (!full) {
        glfwSetWindowMonitor(window_, nullptr, window_x_, window_y_, window_width_, window_height_,
                             GLFW_DONT_CARE);
        return;
    }
    GLFWmonitor* const monitor = glfwGetPrimaryMonitor();
    const GLFWvidmode* const mode = monitor == nullptr ? nullptr : glfwGetVideoMode(monitor);
    if (mode == nullptr) return;
    glfwGetWindowPos(window_, &window_x_, &window_y_);
    glfwGetWindowSize(window_, &window_width_, &window_height_);
    glfwSetWindowMonitor(window_, monitor, 0, 0, mode->width, mode->height, mode->refreshRate);
}

bool Window::is_minimised() const {
    return glfwGetWindowAttrib(window_, GLFW_ICONIFIED) == GLFW_TRUE;
}

bool Window::should_close() const {
    return glfwWindowShouldClose(window_) == GLFW_TRUE;
}

void Window::close() {
    glfwSetWindowShouldClose(window_, GLFW_TRUE);
}

void Window::poll(double wait_s) {
    if (wait_s > 0.0) {
        glfwWaitEventsTimeout(wait_s);
    } else {
        glfwPollEvents();
    }
}

void Window::swap() {
    glfwSwapBuffers(window_);
}

std::pair<int, int> Window::framebuffer_size() const {
    std::pair<int, int> size;
    glfwGetFramebufferSize(window_, &size.first, &size.second);
    return size;
}

int Window::height() const {
    int height = 0;
    glfwGetWindowSize(window_, nullptr, &height);
    return std::max(1, height);
}

float Window::content_scale() const {
    float scale = 1.0f;
    glfwGetWindowContentScale(window_, &scale, nullptr);
    return std::clamp(scale, 0.5f, 4.0f);
}

void Window::bind() const {
    const auto [width, height] = framebuffer_size();
    glBindFramebuffer(GL_FRAMEBUFFER, 0);
    glViewport(0, 0, width, height);
}

}  // namespace paim::player::gl
