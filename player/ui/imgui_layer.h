// Dear ImGui over a window, from first to last frame.
#pragma once

#include "player/gl/window.h"

namespace paim::player {

class ImGuiLayer {
  public:
    // Takes part in the window's events after those already installed.
    explicit ImGuiLayer(const gl::Window& window);
    ~ImGuiLayer();
    ImGuiLayer(const ImGuiLayer&) = delete;
    ImGuiLayer& operator=(const ImGuiLayer&) = delete;

    void begin_frame() const;
    void end_frame() const;  // draws into the current framebuffer

    // True where a panel, not the picture, should have the mouse, or a text field the keys.
    bool wants_mouse() const;
    bool wants_text() const;
};

}  // namespace paim::player
