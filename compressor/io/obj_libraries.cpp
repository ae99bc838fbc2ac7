// Finds material libraries and the materials in them.
#include "compressor/io/obj_libraries.h"

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <set>
#include <string_view>
#include <unordered_map>

#include "compressor/io/file_finder.h"
#include "compressor/io/lower_case.h"
#include "compressor/io/obj_text.h"
#include "paim/base/error.h"
#include "paim/base/file.h"

namespace paim {

namespace {

namespace fs = std::filesystem;

// Limit of all material libraries of one OBJ together. Scenes have far less.
constexpr uint64_t kMaxMaterialBytes = uint64_t{4} << 20;
constexpr size_t kMaxWarnings = 8;
constexpr size_t kMaxWords = 16;       // of the name of a library
constexpr size_t kMaxAllWords = 4096;  // of all mtllib lines; each takes some look-ups of files

bool is_space(char c) {
    return c == ' ' || c == '\t';
}

std::vector<std::string_view> words_of(std::string_view text) {
    std::vector<std::string_view> words;
    for (size_t at = 0; at < text.size();) {
        const size_t begin = at;
        while (at < text.size() && !is_space(text[at])) ++at;
        if (at > begin) words.push_back(text.substr(begin, at - begin));
        while (at < text.size() && is_space(text[at])) ++at;
    }
    return words;
}

// Without quotes round it, and with one space for each run of space.
std::string plain_name(std::string_view text) {
    std::string name;
    for (const std::string_view word : words_of(without_quotes(text))) {
        if (!name.empty()) name += ' ';
        name += word;
    }
    return name;
}

// Without a comment, which begins with a '#' after a space.
std::string_view without_comment(std::string_view text) {
    for (size_t i = 1; i < text.size(); ++i) {
        if (text[i] == '#' && is_space(text[i - 1])) return text.substr(0, i);
    }
    return text;
}

bool ends_in_mtl(std::string_view word) {
    word = word.substr(0, word.find_last_not_of("\"'") + 1);
    return word.size() >= 4 && in_lower_case(word.substr(word.size() - 4)) == ".mtl";
}

class LibraryReader {
  public:
    LibraryReader(const fs::path& folder, bool gloss, ObjLibraries& result)
        : folder_(folder), finder_(folder), gloss_(gloss), result_(result) {}

    // Reads what the line names.
    void read_line(const std::string& line) {
        if (!lines_.insert(line).second) return;
        std::vector<std::string_view> words = words_of(line);
        if (words.size() > num_words_left_) {
            result_.warnings.push_back(fmt::format(
                "mtllib: expected at most {} words in all lines together", kMaxAllWords));
            words.resize(num_words_left_);
        }
        num_words_left_ -= words.size();
        const auto join = [&](size_t first, size_t last) {
            const char* end = words[last].data() + words[last].size();
            return std::string_view(words[first].data(),
                                    static_cast<size_t>(end - words[first].data()));
        };
        for (size_t i = 0; i < words.size();) {
            std::optional<fs::path> path;
            size_t last = std::min(words.size(), i + kMaxWords);
            while (!path && last-- > i) path = finder_.find(join(i, last));
            if (!path) {
                if (i > 0 && words[i][0] == '#') return;
                const size_t end = std::min(words.size(), i + kMaxWords) - 1;
                for (last = i; last < end && !ends_in_mtl(words[last]);) ++last;
                path = find_elsewhere(join(i, last));
            }
            read(*path);
            i = last + 1;
        }
    }

  private:
    // For a name that find() does not know. Reading a file that is not there warns.
    fs::path find_elsewhere(std::string_view name) {
        const auto found = finder_.find_elsewhere(name);
        if (!found) return folder_ / name;
        if (found->in_other_case) {
            result_.warnings.push_back(fmt::format("{}: taken for the material library '{}'",
                                                   found->path.string(), printable(name)));
        }
        return found->path;
    }

    void read(const fs::path& path) {
        if (!read_.insert(path.native()).second) return;
        try {
            std::vector<char> text = read_file(path, kMaxMaterialBytes - num_bytes_);
            num_bytes_ += text.size();
            for (ObjMaterial& material :
                 parse_obj_materials(path.string(), text, gloss_, result_.warnings)) {
                material.folder = path.parent_path();
                result_.materials.push_back(std::move(material));
            }
        } catch (const Error& error) {
            result_.warnings.emplace_back(error.what());
        }
    }

    fs::path folder_;
    FileFinder finder_;
    bool gloss_;
    ObjLibraries& result_;
    std::set<std::string> lines_, read_;
    size_t num_words_left_ = kMaxAllWords;
    uint64_t num_bytes_ = 0;
};

void find_materials(const std::string& name, const ObjScan& scan, ObjLibraries& result) {
    std::unordered_map<std::string, int32_t> exact, plain, uncommented;
    for (size_t i = 0; i < result.materials.size(); ++i) {
        const std::string& material = result.materials[i].name;
        exact.try_emplace(material, static_cast<int32_t>(i));
        plain.try_emplace(plain_name(material), static_cast<int32_t>(i));
        uncommented.try_emplace(plain_name(without_comment(material)), static_cast<int32_t>(i));
    }
    size_t num_unknown = 0;
    std::string first_unknown;
    for (const std::string& wanted : scan.materials) {
        int32_t found = -1;
        const auto look_up = [&](const auto& names, const std::string& key) {
            const auto at = names.find(key);
            if (found < 0 && at != names.end()) found = at->second;
        };
        look_up(exact, wanted);
        // "Mat #2" may be a name or have a comment, so "Mat #1" is never taken for it.
        look_up(plain, plain_name(wanted));
        look_up(uncommented, plain_name(wanted));
        look_up(plain, plain_name(without_comment(wanted)));
        result.of_name.push_back(found);
        if (found < 0 && num_unknown++ == 0) first_unknown = wanted;
    }
    if (num_unknown == 0) return;
    result.warnings.push_back(fmt::format("{}: {} materials not found in any .mtl file, e.g. '{}'",
                                          name, num_unknown, printable(first_unknown)));
}

}  // namespace

void shorten_warnings(const std::string& name, std::vector<std::string>& warnings) {
    std::set<std::string> seen;
    std::erase_if(warnings, [&](const std::string& text) { return !seen.insert(text).second; });
    if (warnings.size() <= kMaxWarnings) return;
    const size_t num_more = warnings.size() - kMaxWarnings;
    warnings.resize(kMaxWarnings);
    warnings.push_back(fmt::format("{}: {} more warnings about material files", name, num_more));
}

ObjLibraries read_obj_libraries(const std::string& name, const std::filesystem::path& folder,
                                const ObjScan& scan, bool gloss) {
    ObjLibraries result;
    LibraryReader reader(folder, gloss, result);
    for (const std::string& line : scan.libraries) reader.read_line(line);
    shorten_warnings(name, result.warnings);
    find_materials(name, scan, result);
    return result;
}

}  // namespace paim
