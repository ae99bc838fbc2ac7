// A directory that is removed with all that is in it.
#pragma once

#include <filesystem>
#include <utility>

namespace paim {

class ScratchDirectory {
  public:
    // Made anew: what an interrupted run left there is removed.
    explicit ScratchDirectory(std::filesystem::path path) : path_(std::move(path)) {
        std::filesystem::remove_all(path_);
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
