// A list of paths, one a line.
#include "player/ui/recent_files.h"

#include <algorithm>
#include <cstdlib>
#include <sstream>
#include <string>
#include <system_error>

#include "paim/base/error.h"
#include "paim/base/file.h"

namespace paim::player {

namespace {

constexpr size_t kMostFiles = 10;
constexpr uint64_t kMostBytes = 100'000;

// Empty if the user has no home.
std::filesystem::path list_path() {
    const char* const state = std::getenv("XDG_STATE_HOME");
    if (state != nullptr && *state != '\0') return std::filesystem::path(state) / "paim/recent";
    const char* const home = std::getenv("HOME");
    if (home == nullptr || *home == '\0') return {};
    return std::filesystem::path(home) / ".local/state/paim/recent";
}

}  // namespace

std::vector<std::filesystem::path> read_recent_files() {
    std::vector<std::filesystem::path> files;
    const std::filesystem::path list = list_path();
    std::error_code ignored;
    if (list.empty() || !std::filesystem::is_regular_file(list, ignored)) return files;
    try {
        const std::vector<char> text = read_file(list, kMostBytes);
        std::istringstream lines(std::string(text.begin(), text.end()));
        for (std::string line; std::getline(lines, line) && files.size() < kMostFiles;) {
            if (std::filesystem::exists(line, ignored)) files.emplace_back(line);
        }
    } catch (const Error&) {  // a list that cannot be read is no reason not to play
    }
    return files;
}

std::vector<std::filesystem::path> add_recent_file(const std::filesystem::path& path) {
    std::error_code ignored;
    const std::filesystem::path whole = std::filesystem::absolute(path, ignored);
    std::vector<std::filesystem::path> files = read_recent_files();
    std::erase(files, whole);
    files.insert(files.begin(), whole);
    files.resize(std::min(files.size(), kMostFiles));
    const std::filesystem::path list = list_path();
    if (list.empty()) return files;
    try {
        ensure_directory(list.parent_path());
        std::string text;
        for (const auto& file : files) text += file.string() + "\n";
        write_file(list, text);
    } catch (const Error&) {
    }
    return files;
}

}  // namespace paim::player
