// OBJ texts as files, and the message of the error that reading them gives.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "compressor/io/obj_scan.h"
#include "compressor/io/obj_sequence.h"
#include "paim/base/error.h"
#include "paim/base/file.h"
#include "tests/temporary_directory.h"

namespace paim {

// Files 0.obj, 1.obj, ... with these contents in a directory of their own.
class ObjTestFiles {
  public:
    explicit ObjTestFiles(const std::vector<std::string>& contents) {
        for (size_t i = 0; i < contents.size(); ++i) {
            files_.push_back(directory_ / (std::to_string(i) + ".obj"));
            write_file(files_.back(), contents[i]);
        }
    }
    const std::vector<std::filesystem::path>& files() const { return files_; }
    void add(const std::string& name, const std::string& contents) const {
        write_file(directory_ / name, contents);
    }
    // The text without the directory's name.
    std::string shortened(std::string text) const {
        const std::string folder = directory_.path().string() + "/";
        for (size_t at = text.find(folder); at != text.npos; at = text.find(folder)) {
            text.erase(at, folder.size());
        }
        return text;
    }
    std::vector<std::string> warnings(const ObjSequence& sequence) const {
        std::vector<std::string> texts;
        for (const std::string& text : sequence.warnings()) texts.push_back(shortened(text));
        return texts;
    }

  private:
    TemporaryDirectory directory_;
    std::vector<std::filesystem::path> files_;
};

// The message of the bad-input error that the action ends in, or a remark that it does not.
inline std::string bad_input_of(const std::function<void()>& action) {
    try {
        action();
    } catch (const Error& error) {
        if (error.code() == ExitCode::bad_input) return error.what();
        return std::string("another exit code: ") + error.what();
    }
    return "no error";
}

// The error of opening a sequence of these contents as 0.obj, 1.obj, ...
inline std::string sequence_error(const std::vector<std::string>& contents,
                                  const ObjOptions& options = {}) {
    const ObjTestFiles files(contents);
    return files.shortened(bad_input_of([&] { ObjSequence(files.files(), options); }));
}

inline ObjScan scan_text(std::string text, const ObjScanOptions& options = {}) {
    return scan_obj("x.obj", text, options);
}

inline std::string scan_error(const std::string& text, const ObjScanOptions& options = {}) {
    return bad_input_of([&] { scan_text(text, options); });
}

inline constexpr const char* kTriangleObj = "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";

}  // namespace paim
