// Wavefront OBJ output of pose sequences, one file a pose.
#pragma once

#include <filesystem>
#include <functional>
#include <span>
#include <string>
#include <string_view>

#include "poses/sequence.h"

namespace paim::poses {

// Formats the files of a sequence. Text that all files share is formatted once.
class ObjWriter {
  public:
    // With `colored`, vertices carry their albedo: "v x y z r g b", linear.
    ObjWriter(std::string name, const Sequence& sequence, bool colored);

    // The file's bytes. Numbers are the shortest that read back as the same floats.
    std::string format(std::span<const Vec3f> positions) const;

  private:
    std::string name_;
    std::vector<std::string> colors_;  // [V] " r g b", or none
    std::string faces_;
};

// "NAME_0012.obj", with more digits if the last pose needs them.
std::string obj_file_name(std::string_view name, uint32_t p, uint32_t num_poses);

// Writes all poses into the directory, several at a time, each all or nothing; calls written()
// after each, from any thread. Errors: output failed.
void write_obj_sequence(const std::string& name, const Sequence& sequence, uint32_t num_poses,
                        bool colored, const std::filesystem::path& directory,
                        const std::function<void()>& written);

}  // namespace paim::poses
