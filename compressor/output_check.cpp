// Checks, before long work, that outputs can be written.
#include "compressor/output_check.h"

#include <unistd.h>

#include <cerrno>
#include <cstring>

#include "paim/base/error.h"
#include "paim/base/file.h"

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

void check_paim_output(const std::filesystem::path& output) {
    check_output(output);
    if (std::filesystem::is_directory(output)) {
        throw_output_failed("{}: is a directory, expected a file name for the .paim",
                            output.string());
    }
}

}  // namespace paim
