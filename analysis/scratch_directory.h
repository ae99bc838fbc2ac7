// A directory that is removed with all that is in it.
#pragma once

#include <fmt/format.h>
#include <unistd.h>

#include <filesystem>
#include <string>

namespace paim {

// Hidden, and of this process, so that it is nobody else's.
class ScratchDirectory {
  public:
    // parent  is there
    ScratchDirectory(const std::filesystem::path& parent, const std::string& name)
        : path_(parent / fmt::format(".{}-{}.tmp", name, ::getpid())) {
        std::filesystem::create_directories(path_);
    }
    ~ScratchDirectory() {
        std::error_code ignored;
        std::filesystem::remove_all(path_, ignored);
    }
    ScratchDirectory(const ScratchDirectory&) = delete;
    ScratchDirectory& operator=(const ScratchDirectory&) = delete;

    const std::filesystem::path& path() const { return path_; }

  private:
    std::filesystem::path path_;
};

}  // namespace paim
