// Xlib and XTest.
#include "tests/player/x_user.h"

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>
#include <X11/Xlib.h>
#include <X11/Xutil.h>
#include <X11/extensions/XTest.h>

#include <cstdlib>
#include <stdexcept>

// As in GLFW/glfw3native.h, which needs the headers of more extensions.
extern "C" {
Display* glfwGetX11Display(void);
::Window glfwGetX11Window(GLFWwindow* window);
}

namespace paim::player {

XUser::XUser(GLFWwindow* window)
    : display_(::XOpenDisplay(nullptr)),
      display_of_window_(::glfwGetX11Display()),
      window_(::glfwGetX11Window(window)) {
    int ignored = 0;
    if (display_ == nullptr ||
        ::XTestQueryExtension(display_, &ignored, &ignored, &ignored, &ignored) == False) {
        throw std::runtime_error("the X server has no XTest");
    }
}

XUser::~XUser() {
    ::XCloseDisplay(display_);
}

// The server has handled all requests, and what it sent to the window's program has arrived there.
void XUser::finish() const {
    ::XSync(display_, False);
    ::XSync(display_of_window_, False);
}

void XUser::hold(const char* name, bool down) {
    const KeyCode code = ::XKeysymToKeycode(display_, ::XStringToKeysym(name));
    if (code == 0) throw std::runtime_error(std::string("no key ") + name);
    ::XTestFakeKeyEvent(display_, code, down ? True : False, CurrentTime);
    finish();
}

void XUser::press(const char* name, bool shift) {
    // GLFW takes two presses of a key with the same time, in milliseconds, for one.
    constexpr std::chrono::milliseconds kTick(2);
    while (std::chrono::steady_clock::now() - last_key_ < kTick) finish();
    if (shift) hold("Shift_L", true);
    hold(name, true);
    hold(name, false);
    if (shift) hold("Shift_L", false);
    last_key_ = std::chrono::steady_clock::now();
}

void XUser::move_to(int x, int y) {
    int root_x = 0, root_y = 0;
    ::Window ignored = 0;
    ::XTranslateCoordinates(display_, window_, DefaultRootWindow(display_), x, y, &root_x, &root_y,
                            &ignored);
    ::XTestFakeMotionEvent(display_, -1, root_x, root_y, CurrentTime);
    finish();
}

void XUser::button(int number, bool down) {
    ::XTestFakeButtonEvent(display_, static_cast<unsigned>(number), down ? True : False,
                           CurrentTime);
    finish();
}

void XUser::turn_wheel(int steps) {
    for (int i = 0; i < std::abs(steps); ++i) {
        button(steps > 0 ? 4 : 5, true);
        button(steps > 0 ? 4 : 5, false);
    }
}

ScreenPicture XUser::look() const {
    finish();
    XWindowAttributes window{};
    ::XGetWindowAttributes(display_, window_, &window);
    ScreenPicture picture{window.width, window.height, {}};
    XImage* const image = ::XGetImage(display_, window_, 0, 0, static_cast<unsigned>(window.width),
                                      static_cast<unsigned>(window.height), AllPlanes, ZPixmap);
    if (image == nullptr) throw std::runtime_error("the window cannot be seen");
    for (int y = 0; y < window.height; ++y) {
        for (int x = 0; x < window.width; ++x) {
            const unsigned long pixel = XGetPixel(image, x, y);  // 8 bits a channel, red first
            picture.pixels.push_back({static_cast<uint8_t>(pixel >> 16 & 255),
                                      static_cast<uint8_t>(pixel >> 8 & 255),
                                      static_cast<uint8_t>(pixel & 255)});
        }
    }
    XDestroyImage(image);
    return picture;
}

void XUser::resize(int width, int height) {
    ::XResizeWindow(display_, window_, static_cast<unsigned>(width), static_cast<unsigned>(height));
    finish();
}

void XUser::minimise(bool hidden) {
    const Atom wm_state = ::XInternAtom(display_, "WM_STATE", False);
    const long state[] = {hidden ? IconicState : NormalState, None};
    ::XChangeProperty(display_, window_, wm_state, wm_state, 32, PropModeReplace,
                      reinterpret_cast<const unsigned char*>(state), 2);
    if (hidden) {
        ::XUnmapWindow(display_, window_);
    } else {
        ::XMapWindow(display_, window_);
    }
    finish();
}

std::string XUser::title() const {
    char* name = nullptr;
    if (::XFetchName(display_, window_, &name) == 0) return {};
    std::string title = name;
    ::XFree(name);
    return title;
}

}  // namespace paim::player
