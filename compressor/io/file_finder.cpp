// Finds files by the names that other machines wrote.
#include "compressor/io/file_finder.h"

#include <algorithm>
#include <system_error>
#include <utility>

#include "compressor/io/lower_case.h"

namespace paim {

namespace {

namespace fs = std::filesystem;

// Without backslashes before spaces, as shells and some exporters write names.
std::string without_escapes(std::string_view text) {
    std::string name;
    for (size_t i = 0; i < text.size(); ++i) {
        const bool escapes =
            text[i] == '\\' && i + 1 < text.size() && (text[i + 1] == ' ' || text[i + 1] == '\t');
        if (!escapes) name += text[i];
    }
    return name;
}

// The first file that look_up() knows one of the forms of the name of.
template <typename LookUp>
std::optional<fs::path> find_form(std::string_view name, const LookUp& look_up) {
    std::string last_tried;
    for (const std::string_view form : {name, without_quotes(name)}) {
        std::string slashes(form);
        std::replace(slashes.begin(), slashes.end(), '\\', '/');
        for (const std::string& tried : {std::string(form), slashes, without_escapes(form)}) {
            if (tried == last_tried) continue;
            if (auto path = look_up(tried)) return path;
            last_tried = tried;
        }
    }
    return std::nullopt;
}

}  // namespace

std::string_view without_quotes(std::string_view text) {
    const bool quoted =
        text.size() >= 2 && (text[0] == '"' || text[0] == '\'') && text.back() == text[0];
    return quoted ? text.substr(1, text.size() - 2) : text;
}

std::optional<fs::path> FileFinder::existing(const std::string& name) const {
    std::error_code failure;
    fs::path path = folder_ / name;
    if (name.empty() || !fs::exists(path, failure)) return std::nullopt;
    return path;
}

std::optional<fs::path> FileFinder::find(std::string_view name) const {
    return find_form(name, [this](const std::string& form) { return existing(form); });
}

std::optional<FileFinder::Elsewhere> FileFinder::find_elsewhere(std::string_view name) {
    const auto in_other_case = [this](const std::string& form) { return find_in_other_case(form); };
    if (auto path = find_form(name, in_other_case)) return Elsewhere{std::move(*path), true};
    std::string_view last_part = without_quotes(name);
    const size_t separator = last_part.find_last_of("/\\");
    if (separator == std::string_view::npos) return std::nullopt;
    last_part.remove_prefix(separator + 1);
    if (auto path = existing(std::string(last_part))) return Elsewhere{std::move(*path), false};
    if (auto path = find_in_other_case(last_part)) return Elsewhere{std::move(*path), true};
    return std::nullopt;
}

// Of each part of the path as it is written, or else of the only one that differs from it in case
// only. Nothing if there is no regular file, or if `name` is absolute.
std::optional<fs::path> FileFinder::find_in_other_case(const fs::path& name) {
    if (name.empty() || name.is_absolute()) return std::nullopt;
    fs::path path = folder_;
    std::error_code failure;
    for (const fs::path& part : name) {
        fs::path next = path / part;
        if (!fs::exists(next, failure)) {
            const std::string* const only = only_entry(path, part.native());
            if (only == nullptr) return std::nullopt;
            next = path / *only;
        }
        path = std::move(next);
    }
    return fs::is_regular_file(path, failure) ? std::optional(path) : std::nullopt;
}

const std::string* FileFinder::only_entry(const fs::path& folder, const std::string& name) {
    const auto [known, is_new] = folders_.try_emplace(folder.native());
    if (is_new) {
        // "" is the folder of "x.obj". A folder that cannot be read is empty.
        std::error_code failure;
        fs::directory_iterator at(folder.empty() ? fs::path(".") : folder, failure);
        for (; !failure && at != fs::directory_iterator(); at.increment(failure)) {
            std::string entry = at->path().filename().native();
            known->second[in_lower_case(entry)].push_back(std::move(entry));
        }
    }
    const auto found = known->second.find(in_lower_case(name));
    if (found == known->second.end() || found->second.size() != 1) return nullptr;
    return &found->second[0];
}

}  // namespace paim
