// Presses keys in the window of another program, through X.
#pragma once

#include <X11/Xlib.h>
#include <X11/Xutil.h>
#include <X11/keysym.h>
#include <poll.h>

#include <stdexcept>
#include <string>

namespace paim::player {

class WindowKeys {
  public:
    // Waits until a window with this title is shown. Throws std::runtime_error if no window is
    // shown for five minutes: only a test that fails takes so long.
    explicit WindowKeys(const std::string& title) : display_(::XOpenDisplay(nullptr)) {
        if (display_ == nullptr) throw std::runtime_error("no display");
        const ::Window root = ::XDefaultRootWindow(display_);
        ::XSelectInput(display_, root, SubstructureNotifyMask);
        window_ = find(root, title);
        while (window_ == 0) {
            if (!wait_for_a_shown_window()) throw std::runtime_error("no window '" + title + "'");
            window_ = find(root, title);
        }
    }
    ~WindowKeys() { ::XCloseDisplay(display_); }
    WindowKeys(const WindowKeys&) = delete;
    WindowKeys& operator=(const WindowKeys&) = delete;

    // name  as XStringToKeysym() knows it
    void press(const char* name) const {
        XKeyEvent event{};
        event.display = display_;
        event.window = window_;
        event.root = ::XDefaultRootWindow(display_);
        event.same_screen = True;
        event.keycode = ::XKeysymToKeycode(display_, ::XStringToKeysym(name));
        for (const auto& [type, mask] :
             {std::pair{KeyPress, KeyPressMask}, std::pair{KeyRelease, KeyReleaseMask}}) {
            event.type = type;
            ++time_ms_;
            event.time = time_ms_;
            ::XSendEvent(display_, window_, True, mask, reinterpret_cast<XEvent*>(&event));
        }
        ::XFlush(display_);
    }

  private:
    bool wait_for_a_shown_window() const {
        constexpr int kHungAfterMs = 300'000;
        XEvent event{};
        while (event.type != MapNotify) {
            pollfd ready{XConnectionNumber(display_), POLLIN, 0};
            if (::XPending(display_) == 0 && ::poll(&ready, 1, kHungAfterMs) <= 0) return false;
            ::XNextEvent(display_, &event);
        }
        return true;
    }
    ::Window find(::Window parent, const std::string& title) const {
        ::Window root = 0, above = 0;
        ::Window* children = nullptr;
        unsigned count = 0;
        ::Window found = 0;
        if (::XQueryTree(display_, parent, &root, &above, &children, &count) == 0) return 0;
        for (unsigned i = 0; i < count && found == 0; ++i) {
            char* name = nullptr;
            if (::XFetchName(display_, children[i], &name) != 0) {
                if (title == name) found = children[i];
                ::XFree(name);
            }
        }
        if (children != nullptr) ::XFree(children);
        return found;
    }

    Display* display_;
    ::Window window_ = 0;
    mutable ::Time time_ms_ = 1000;
};

}  // namespace paim::player
