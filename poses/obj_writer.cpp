// Formats and writes OBJ files.
#include "poses/obj_writer.h"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <utility>

#include "paim/base/check.h"
#include "paim/base/file.h"
#include "paim/base/parallel.h"

namespace paim::poses {

ObjWriter::ObjWriter(std::string name, const Sequence& sequence, bool colored)
    : name_(std::move(name)) {
    if (colored) {
        for (uint32_t v = 0; v < sequence.topology().num_vertices; ++v) {
            const Vec3f& color = sequence.albedo().at(v);
            // Four digits are finer than any display, and keep the files small.
            colors_.push_back(
                fmt::format(" {:.4g} {:.4g} {:.4g}", color.x(), color.y(), color.z()));
        }
    }
    auto out = std::back_inserter(faces_);
    for (const Triangle& t : sequence.topology().triangles) {
        fmt::format_to(out, "f {} {} {}\n", t[0] + 1, t[1] + 1, t[2] + 1);
    }
}

std::string ObjWriter::format(std::span<const Vec3f> positions) const {
    PAIM_CHECK(colors_.empty() || colors_.size() == positions.size());
    fmt::memory_buffer buffer;
    buffer.reserve(positions.size() * 64 + faces_.size());
    auto out = fmt::appender(buffer);
    fmt::format_to(out, "o {}\n", name_);
    for (size_t v = 0; v < positions.size(); ++v) {
        const Vec3f& position = positions[v];
        fmt::format_to(out, "v {} {} {}", position.x(), position.y(), position.z());
        if (!colors_.empty()) buffer.append(colors_[v]);
        buffer.push_back('\n');
    }
    buffer.append(faces_);
    return fmt::to_string(buffer);
}

std::string obj_file_name(std::string_view name, uint32_t p, uint32_t num_poses) {
    const size_t num_digits = std::max<size_t>(4, std::to_string(num_poses - 1).size());
    return fmt::format("{}_{:0{}}.obj", name, p, num_digits);
}

void write_obj_sequence(const std::string& name, const Sequence& sequence, uint32_t num_poses,
                        bool colored, const std::filesystem::path& directory,
                        const std::function<void()>& written) {
    ensure_directory(directory);
    const ObjWriter writer(name, sequence, colored);
    parallel_for(num_poses, 1, [&](size_t begin, size_t end) {
        for (size_t i = begin; i < end; ++i) {
            const auto p = static_cast<uint32_t>(i);
            write_file(directory / obj_file_name(name, p, num_poses),
                       writer.format(sequence.positions(p, num_poses)));
            written();
        }
    });
}

}  // namespace paim::poses
