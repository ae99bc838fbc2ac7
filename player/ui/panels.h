// The panels over the picture: what they show, and what people ask for in them.
#pragma once

#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "player/gl/handle.h"
#include "player/inspect/accuracy.h"
#include "player/inspect/legend.h"
#include "player/inspect/surface_colors.h"
#include "player/ui/keys.h"
#include "player/view/view_state.h"

namespace paim::player {

// The vertex that was clicked.
struct PickedInfo {
    PickedVertex vertex;
    const gl::TextureHandle* lobe = nullptr;  // its transfer
    std::string history_title;
    std::span<const float> history;  // its error, pose after pose, as far as it is known
    size_t num_poses = 0;            // that it will have
};

// A place of the picture, as fractions from its upper left corner.
struct PicturePlace {
    float x, y;
};

// What the panels show besides the view.
struct PanelInfo {
    std::string title;        // the file's name
    std::string environment;  // the light's
    std::string renderer;
    std::string decoder;
    std::string message;  // of the last moments, or empty
    std::string loading;  // how much of the file is there, or empty
    uint64_t file_bytes = 0, texture_bytes = 0, buffer_bytes = 0;
    uint32_t num_vertices = 0, num_triangles = 0;
    bool has_gloss = false, has_textures = false;
    double frame_ms = 0.0;
    float poses_per_second = 24.0f;

    Cost cost{};
    std::optional<Accuracy> accuracy;  // once it is known
    std::string accuracy_note;         // why the file states no error, or empty
    std::string vertex_components;     // what the codec calls them, if there are any

    const gl::TextureHandle* globe_light = nullptr;
    const gl::TextureHandle* globe_reconstruction = nullptr;
    double negative_share = 0.0;

    const Legend* legend = nullptr;
    const gl::TextureHandle* coefficient_lobe = nullptr;
    std::optional<PicturePlace> worst;  // vertex, where it is seen
    std::optional<PickedInfo> picked;
    std::optional<PicturePlace> picked_place;

    std::optional<float> recorded;  // share of a clip that is being written
};

// What the window remembers of its panels.
struct PanelState {
    bool show_panels = true;
    bool show_help = false;
    bool show_open = false;
    bool light_is_open = false;    // the section of the light
    std::filesystem::path folder;  // that the open panel lists; empty: not listed yet
    std::vector<std::filesystem::path> folders, files;
    std::vector<std::filesystem::path> recent;
};

// What somebody asked for in a panel.
struct PanelRequests {
    std::vector<WindowCommand> commands;
    std::optional<std::filesystem::path> open;
};

// Between ImGuiLayer::begin_frame() and end_frame(). Changes the view.
PanelRequests draw_panels(const PanelInfo& info, const ViewRange& range, PanelState& state,
                          ViewState& view);

// The parts of draw_panels(), one file each.
void draw_accuracy(const PanelInfo& info, const ViewRange& range, ViewState& view);
void draw_light(const PanelInfo& info, ViewState& view);
void draw_picture(ViewState& view, PanelRequests& requests);
void draw_surface(const PanelInfo& info, const ViewRange& range, ViewState& view);
void draw_camera(const PanelInfo& info, ViewState& view, PanelRequests& requests);
void draw_timeline(const ViewRange& range, float poses_per_second, ViewState& view);
float timeline_height();  // screen coordinates
void draw_legend(const PanelInfo& info);
void draw_picked(const PanelInfo& info, ViewState& view);
void draw_markers(const PanelInfo& info);
void draw_open(PanelState& state, PanelRequests& requests);
void draw_help();

}  // namespace paim::player
