// The keyboard: one table says which key does what, for the window, its help and --help alike.
#pragma once

#include <span>
#include <string>

#include "player/ui/view_state.h"

namespace paim::player {

enum class Command {
    none,
    play_pause,
    previous_pose,
    next_pose,
    first_pose,
    last_pose,
    fewer_transfer_components,
    more_transfer_components,
    fewer_vertex_components,
    more_vertex_components,
    fewer_geometry_components,
    more_geometry_components,
    fewer_bands,
    more_bands,
    lower_exposure,
    raise_exposure,
    lower_gamma,
    raise_gamma,
    turn_light_clockwise,
    turn_light_counter_clockwise,
    auto_turn,
    next_background,
    toggle_panel,
    toggle_help,
    // Those that change more than the view:
    frame_all,
    snapshot,
    quit,
};

struct KeyBinding {
    int glfw_key = 0;
    bool shift = false;
    Command command = Command::none;
};

// One line of the help with the bindings of its keys.
struct KeyRow {
    const char* keys;
    std::string meaning;
    KeyBinding first;
    KeyBinding second = {};  // of a pair of keys
};

std::span<const KeyRow> key_table();

// The table as text, for --help.
std::string keys_help();

// What a GLFW key, with or without Shift, asks for.
Command command_of_key(int glfw_key, bool shift);

// Carries out a command on the view; does nothing for those that change more than it.
void apply(Command command, ViewState& view, const ViewRange& range);

}  // namespace paim::player
