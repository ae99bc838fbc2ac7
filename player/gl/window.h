// A window with an OpenGL 3.3 core context, through GLFW.
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
    std::function<void(int glfw_key, bool shift)> on_key;  // pressed, or repeated
    std::function<void(MouseButton button, double dx, double dy)> on_drag;
    std::function<void(double steps)> on_scroll;
    std::function<void(const std::vector<std::filesystem::path>& paths)> on_drop;
};

class Window : public Context {
  public:
    // Throws Error(unsupported) with GLFW's reason: no display, no OpenGL 3.3.
    Window(int width, int height, const std::string& title);
    ~Window() override;
    Window(const Window&) = delete;
    Window& operator=(const Window&) = delete;

    GLFWwindow* handle() const { return window_; }
    WindowEvents& events() { return events_; }

    bool should_close() const;
    void close();

    // Handles what has happened; waits for at most wait_s, if it is not 0, for something to happen.
    void poll(double wait_s);
    void swap();

    std::pair<int, int> framebuffer_size() const;  // pixels; 0 x 0 while minimised
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
    void install_callbacks();
    void on_cursor(double x, double y);

    Library library_;
    GLFWwindow* window_ = nullptr;
    WindowEvents events_;
    double cursor_x_ = 0.0;
    double cursor_y_ = 0.0;
};

}  // namespace paim::player::gl
