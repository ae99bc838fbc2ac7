// The keyboard: one table says which key does what, for the window, its help and --help alike.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "player/view/view_state.h"

namespace paim::player {

// What keys do that changes more than the view.
enum class WindowCommand {
    none,
    frame_all,
    frame_pose,
    follow_body,
    auto_exposure,
    snapshot_png,
    snapshot_exr,
    save_view,
    open_file,
    record,
    full_screen,
    toggle_panels,
    toggle_help,
    quit,
};

struct KeyBinding {
    int glfw_key = 0;
    bool shift = false;
    // One of the two.
    void (*change)(ViewState& view, const ViewRange& range) = nullptr;
    WindowCommand command = WindowCommand::none;
    bool repeats = false;  // again and again while the key is held
};

// One line of the help with the bindings of its keys.
struct KeyRow {
    std::string keys;
    std::string meaning;
    std::vector<KeyBinding> bindings;
};

// Rows of one subject.
struct KeyGroup {
    std::string title;
    std::vector<KeyRow> rows;
};

std::span<const KeyGroup> key_groups();

// The table as text, for --help.
std::string keys_help();

// What a GLFW key, with or without Shift, does; nullptr: nothing.
const KeyBinding* find_key(int glfw_key, bool shift);

}  // namespace paim::player
