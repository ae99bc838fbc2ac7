// Somebody before the screen: works the keyboard and the mouse of an X server, and sees a window.
// Events are made by the XTest extension, so that they take the way of real ones.
#pragma once

#include <array>
#include <chrono>
#include <cstdint>
#include <string>
#include <vector>

struct GLFWwindow;
struct _XDisplay;

namespace paim::player {

// Display values. Row 0 is the top row.
struct ScreenPicture {
    int width = 0, height = 0;
    std::vector<std::array<uint8_t, 3>> pixels;  // [height · width]

    const std::array<uint8_t, 3>& at(int x, int y) const {
        return pixels[static_cast<size_t>(y) * static_cast<size_t>(width) + static_cast<size_t>(x)];
    }
    bool operator==(const ScreenPicture&) const = default;
};

// All is done, and lies in the event queue of the window's program, when a function returns. Places
// are pixels of the window from its upper left corner.
class XUser {
  public:
    // window  of this program. Throws std::runtime_error if there is no XTest.
    explicit XUser(GLFWwindow* window);
    ~XUser();
    XUser(const XUser&) = delete;
    XUser& operator=(const XUser&) = delete;

    // name  as XStringToKeysym() knows it
    void press(const char* name, bool shift = false);
    void hold(const char* name, bool down);
    void move_to(int x, int y);
    void button(int number, bool down);  // 1 left, 2 middle, 3 right
    void turn_wheel(int steps);          // positive: away from the user

    ScreenPicture look() const;

    void resize(int width, int height);
    // What a window manager does when it minimises the window or shows it again.
    void minimise(bool hidden);
    std::string title() const;

  private:
    void finish() const;

    _XDisplay* display_;
    _XDisplay* display_of_window_;  // the connection of the window's program
    unsigned long window_;
    std::chrono::steady_clock::time_point last_key_{};
};

}  // namespace paim::player
