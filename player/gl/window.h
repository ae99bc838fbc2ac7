// A window with an OpenGL 3.3 core context, or OpenGL ES 3.0 where there is none, through GLFW.
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "player/gl/context.h"

struct GLFWwindow;

namespace paim::player::gl {

enum class MouseButton { left, right, middle };

// What the window calls when something happens. Positions and movements in screen coordinates.
struct WindowEvents {
    // repeated  held for a while, rather than pressed
    std::function<void(int glfw_key, bool shift, bool repeated)> on_key;
    // ctrl  whether a Ctrl key is held
    std::function<void(MouseButton button, bool ctrl, double dx, double dy)> on_drag;
    // The left button was pressed and released in one place. x, y  0 … 1 from the upper left corner
    std::function<void(double x, double y)> on_click;
    std::function<void(double steps)> on_scroll;
    std::function<void(const std::vector<std::filesystem::path>& paths)> on_drop;
    // Anything has happened after which the window may look different: one of the above, or a new size.
    std::function<void()> on_any;
};

class Window : public Context {
  public:
    // Throws Error(unsupported) with GLFW's reason: no display, neither OpenGL 3.3 nor OpenGL ES 3.0.
    Window(int width, int height, const std::string& title);
    ~Window() override;
    Window(const Window&) = delete;
    Window& operator=(const Window&) = delete;

    GLFWwindow* handle() const { return window_; }
    WindowEvents& events() { return events_; }

    void set_title(const std::string& title);
    // The whole screen of the primary monitor, or the window's place and size before that.
    void set_full_screen(bool full);
    bool is_full_screen() const;

    bool is_minimised() const;
    bool should_close() const;
    void close();

    // Handles what has happened; waits for at most wait_s, if it is not 0, for something to happen.
    void poll(double wait_s);
    void swap();

    std::pair<int, int> framebuffer_size() const;  // pixels; may be 0 x 0 while minimised
    int height() const;                            // screen coordinates, at least 1
    float content_scale() const;                   // 1 on ordinary displays, 2 on dense ones

    // The framebuffer of the window becomes what is drawn into.
    void bind() const;

  private:
    // Ends GLFW after the window is gone.
    struct Library {
        Library();
        ~Library();
    };

    static Window& of(GLFWwindow* window);
    void open(int width, int height, const std::string& title);
    void install_callbacks();
    void install_mouse_callbacks();
    void on_cursor(double x, double y);
    void on_left_button(bool pressed);
    bool is_pressed(int glfw_key) const;
    void tell() const;

    Library library_;
    GLFWwindow* window_ = nullptr;
    WindowEvents events_;
    double cursor_x_ = 0.0;
    double cursor_y_ = 0.0;
    double pressed_x_ = 0.0, pressed_y_ = 0.0;  // where the left button went down
    int window_x_ = 0, window_y_ = 0, window_width_ = 0, window_height_ = 0;  // before full screen
};

}  // namespace paim::player::gl
