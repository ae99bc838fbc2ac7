// Where a pilot bake is while its noise is measured.
#pragma once

#include <filesystem>

namespace paim {

// A hidden directory next to a bake, of this process alone. The destructor removes it with the bake in
// it. What killed processes left is removed when the next one is made for the same bake.
class PilotDirectory {
  public:
    // Errors (output failed), naming the path.
    explicit PilotDirectory(const std::filesystem::path& bake);
    ~PilotDirectory();
    PilotDirectory(const PilotDirectory&) = delete;
    PilotDirectory& operator=(const PilotDirectory&) = delete;

    const std::filesystem::path& path() const { return path_; }

    // Makes the pilot the bake. Returns false, and nothing has changed, if a directory with files is
    // there.
    bool become(const std::filesystem::path& bake) const;

  private:
    std::filesystem::path path_;
    int lock_ = -1;
};

}  // namespace paim
