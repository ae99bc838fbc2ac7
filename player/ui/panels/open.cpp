// Files to open: those of a folder, and those opened last.
#include <algorithm>
#include <system_error>

#include "player/ui/panels.h"
#include "player/ui/widgets.h"

namespace paim::player {

namespace {

bool can_be_opened(const std::filesystem::path& path) {
    return path.extension() == ".paim" || path.extension() == ".exr";
}

// Folders and files of state.folder, by name. A folder that cannot be read is empty.
void list_folder(PanelState& state) {
    constexpr size_t kMost = 10000;
    state.folders.clear();
    state.files.clear();
    std::error_code error;
    std::filesystem::directory_iterator entries(state.folder, error), end;
    for (size_t count = 0; !error && entries != end && count < kMost; entries.increment(error)) {
        std::error_code ignored;
        const std::filesystem::path& path = entries->path();
        if (entries->is_directory(ignored)) {
            if (!path.filename().string().starts_with('.')) state.folders.push_back(path);
        } else if (can_be_opened(path)) {
            state.files.push_back(path);
        }
        ++count;
    }
    std::sort(state.folders.begin(), state.folders.end());
    std::sort(state.files.begin(), state.files.end());
}

void go_to(const std::filesystem::path& folder, PanelState& state) {
    state.folder = folder;
    list_folder(state);
}

}  // namespace

void draw_open(PanelState& state, PanelRequests& requests) {
    if (!state.show_open) return;
    if (state.folder.empty()) {
        std::error_code ignored;
        go_to(std::filesystem::current_path(ignored), state);
    }
    const ImVec2 size = ImGui::GetIO().DisplaySize;
    ImGui::SetNextWindowPos(ImVec2(0.5f * size.x, 0.5f * size.y), ImGuiCond_Appearing,
                            ImVec2(0.5f, 0.5f));
    ImGui::SetNextWindowSize(
        ImVec2(std::min(0.6f * size.x, 36.0f * ImGui::GetFontSize()), 0.7f * size.y),
        ImGuiCond_Appearing);
    ImGui::SetNextWindowBgAlpha(1.0f);  // panels under it would be read as part of it
    std::optional<std::filesystem::path> folder;
    if (ImGui::Begin("Open a model (.paim) or a light (.exr)", &state.show_open,
                     ImGuiWindowFlags_NoSavedSettings | ImGuiWindowFlags_NoCollapse)) {
        const auto file_row = [&](const std::filesystem::path& path, const std::string& label) {
            ImGui::PushID(path.c_str());
            if (ImGui::Selectable(label.c_str())) requests.open = path;
            ImGui::PopID();
        };
        if (!state.recent.empty()) {
            dim_text("opened last");
            for (const auto& path : state.recent) file_row(path, path.string());
            ImGui::Separator();
        }
        note_text(state.folder.string());
        if (ImGui::Selectable("..")) folder = state.folder.parent_path();
        for (const auto& path : state.folders) {
            if (ImGui::Selectable((path.filename().string() + "/").c_str())) folder = path;
        }
        for (const auto& path : state.files) file_row(path, path.filename().string());
    }
    ImGui::End();
    if (folder) go_to(*folder, state);
    if (requests.open) state.show_open = false;
}

}  // namespace paim::player
