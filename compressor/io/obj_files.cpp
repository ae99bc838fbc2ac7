// Finds the OBJ files of a pose sequence.
#include "compressor/io/obj_files.h"

#include <glob.h>

#include <algorithm>
#include <new>
#include <system_error>

#include "compressor/io/frame_notes.h"
#include "compressor/io/lower_case.h"
#include "compressor/io/natural_order.h"
#include "paim/base/error.h"

namespace paim {

namespace {

namespace fs = std::filesystem;

bool is_obj_file(const fs::path& path) {
    std::string extension = path.extension().string();
    std::transform(extension.begin(), extension.end(), extension.begin(), lower_case);
    std::error_code ignored;
    return extension == ".obj" && !fs::is_directory(path, ignored);
}

std::vector<fs::path> list_folder(const fs::path& folder) {
    std::vector<fs::path> files;
    size_t num_hidden = 0;
    std::error_code failure;
    for (fs::directory_iterator entry(folder, failure), end; !failure && entry != end;
         entry.increment(failure)) {
        if (!is_obj_file(entry->path())) continue;
        // Some systems put a hidden file (._x.obj) with other data next to every file.
        if (entry->path().filename().native().starts_with('.')) {
            ++num_hidden;
        } else {
            files.push_back(entry->path());
        }
    }
    if (failure) {
        throw_bad_input("{}: cannot read directory: {}", folder.string(), failure.message());
    }
    if (files.empty() && num_hidden > 0) {
        throw_bad_input("{}: no OBJ files in this directory but {} hidden ones (.*.obj)",
                        folder.string(), num_hidden);
    }
    if (files.empty()) throw_bad_input("{}: no OBJ files in this directory", folder.string());
    return files;
}

std::vector<fs::path> expand_pattern(const std::string& pattern) {
    struct Matches : glob_t {
        Matches() : glob_t{} {}
        ~Matches() { ::globfree(this); }
    } matches;
    const int result = ::glob(pattern.c_str(), GLOB_NOSORT, nullptr, &matches);
    if (result == GLOB_NOSPACE) throw std::bad_alloc();
    std::vector<fs::path> files;
    for (size_t i = 0; result == 0 && i < matches.gl_pathc; ++i) {
        if (is_obj_file(matches.gl_pathv[i])) files.emplace_back(matches.gl_pathv[i]);
    }
    if (files.empty()) throw_bad_input("{}: no OBJ files match this pattern", pattern);
    return files;
}

}  // namespace

std::vector<fs::path> find_obj_files(const std::vector<std::string>& arguments, bool keep_order,
                                     std::vector<std::string>* notes) {
    if (arguments.empty()) throw_bad_input("no OBJ files: expected at least one");
    std::vector<fs::path> all;
    for (const std::string& argument : arguments) {
        std::vector<fs::path> files;
        std::error_code ignored;
        if (fs::is_directory(argument, ignored)) {
            files = list_folder(argument);
        } else if (argument.find_first_of("*?[") != std::string::npos &&
                   !fs::exists(argument, ignored)) {
            files = expand_pattern(argument);
        } else {
            files = {argument};
        }
        sort_naturally(files);
        if (keep_order && notes != nullptr) append_frame_notes(files, *notes);
        all.insert(all.end(), files.begin(), files.end());
    }
    if (!keep_order) {
        for (fs::path& path : all) path = path.lexically_normal();
        sort_naturally(all);
        all.erase(std::unique(all.begin(), all.end()), all.end());
        if (notes != nullptr) append_frame_notes(all, *notes);
    }
    return all;
}

}  // namespace paim
