// GLFW. Its callbacks find the window through the user pointer.
#include "player/gl/window.h"

#include <epoxy/gl.h>
#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>

#include <algorithm>
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
    glfwWindowHint(GLFW_CONTEXT_VERSION_MAJOR, 3);
    glfwWindowHint(GLFW_CONTEXT_VERSION_MINOR, 3);
    glfwWindowHint(GLFW_OPENGL_PROFILE, GLFW_OPENGL_CORE_PROFILE);
    glfwWindowHint(GLFW_OPENGL_FORWARD_COMPAT, GLFW_TRUE);
    // The picture has its own depth buffer.
    glfwWindowHint(GLFW_DEPTH_BITS, 0);
    glfwWindowHint(GLFW_STENCIL_BITS, 0);
    window_ = glfwCreateWindow(width, height, title.c_str(), nullptr, nullptr);
    if (window_ == nullptr) {
        throw_unsupported(
            "no window with OpenGL 3.3 can be opened ({}); --snapshot OUT.png draws without one",
            last_failure());
    }
    glfwMakeContextCurrent(window_);
    require_version();
    glfwSwapInterval(1);
    install_callbacks();
}

Window::~Window() {
    if (window_ != nullptr) glfwDestroyWindow(window_);
}

Window& Window::of(GLFWwindow* window) {
    return *static_cast<Window*>(glfwGetWindowUserPointer(window));
}

void Window::install_callbacks() {
    glfwSetWindowUserPointer(window_, this);
    glfwGetCursorPos(window_, &cursor_x_, &cursor_y_);
    glfwSetKeyCallback(window_, [](GLFWwindow* window, int key, int, int action, int modifiers) {
        const auto& on_key = of(window).events_.on_key;
        if (action != GLFW_RELEASE && on_key) on_key(key, (modifiers & GLFW_MOD_SHIFT) != 0);
    });
    glfwSetCursorPosCallback(
        window_, [](GLFWwindow* window, double x, double y) { of(window).on_cursor(x, y); });
    glfwSetScrollCallback(window_, [](GLFWwindow* window, double, double steps) {
        const auto& on_scroll = of(window).events_.on_scroll;
        if (on_scroll) on_scroll(steps);
    });
    glfwSetDropCallback(window_, [](GLFWwindow* window, int count, const char** names) {
        const auto& on_drop = of(window).events_.on_drop;
        if (on_drop) on_drop(std::vector<std::filesystem::path>(names, names + count));
    });
}

void Window::on_cursor(double x, double y) {
    const double dx = x - std::exchange(cursor_x_, x);
    const double dy = y - std::exchange(cursor_y_, y);
    constexpr std::pair<int, MouseButton> kButtons[] = {
        {GLFW_MOUSE_BUTTON_LEFT, MouseButton::left},
        {GLFW_MOUSE_BUTTON_RIGHT, MouseButton::right},
        {GLFW_MOUSE_BUTTON_MIDDLE, MouseButton::middle}};
    for (const auto& [glfw_button, button] : kButtons) {
        if (glfwGetMouseButton(window_, glfw_button) == GLFW_PRESS && events_.on_drag) {
            events_.on_drag(button, dx, dy);
            return;
        }
    }
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
