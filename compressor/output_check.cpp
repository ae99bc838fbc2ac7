// Checks, before long work, that outputs can be written.
#include "compressor/output_check.h"

#include <unistd.h>

#include <cerrno>
#include <cstring>

#include "compressor/encode/memory/memory_plan.h"
#include "paim/base/error.h"
#include "paim/base/file.h"
#include "paim/format/bake/bake_directory.h"

namespace paim {

void check_output(const std::filesystem::path& output) {
    const std::filesystem::path target = follow_links(std::filesystem::absolute(output));
    const std::filesystem::path parent = target.parent_path();
    std::error_code ignored;
    if (!std::filesystem::is_directory(parent, ignored)) {
        throw_output_failed("{}: the directory {} does not exist", output.string(),
                            parent.string());
    }
    if (::access(parent.c_str(), W_OK) != 0) {
        throw_output_failed("{}: cannot write to {}: {}", output.string(), parent.string(),
                            std::strerror(errno));
    }
    const long longest_name = ::pathconf(parent.c_str(), _PC_NAME_MAX);
    const size_t name_bytes = target.filename().string().size();
    if (longest_name >= 0 && name_bytes + kMaxTemporarySuffix > static_cast<size_t>(longest_name)) {
        throw_output_failed("{}: a name of {} bytes, expected at most {}", output.string(),
                            name_bytes, longest_name - static_cast<long>(kMaxTemporarySuffix));
    }
}

void check_bake_space(const std::filesystem::path& directory, uint64_t pose_bytes, uint32_t first,
                      uint32_t last) {
    std::error_code failure;
    uint64_t num_missing = 0;
    for (uint64_t p = first; p <= last; ++p) {
        const auto file = bake_pose_file(directory, static_cast<uint32_t>(p));
        if (!std::filesystem::exists(file, failure)) ++num_missing;
    }
    const auto target = follow_links(std::filesystem::absolute(directory));
    const auto space = std::filesystem::space(
        std::filesystem::is_directory(target, failure) ? target : target.parent_path(), failure);
    if (failure) return;  // nothing is known about the disk
    const double needed = static_cast<double>(num_missing) * static_cast<double>(pose_bytes);
    if (needed <= static_cast<double>(space.available)) return;
    throw_output_failed("{}: {} poses of {} take {:.3g} GB, but {:.3g} GB of the disk are free",
                        directory.string(), num_missing, memory_text(pose_bytes), 1e-9 * needed,
                        1e-9 * static_cast<double>(space.available));
}

void check_paim_output(const std::filesystem::path& output) {
    check_output(output);
    if (std::filesystem::is_directory(output)) {
        throw_output_failed("{}: is a directory, expected a file name for the .paim",
                            output.string());
    }
}

}  // namespace paim
