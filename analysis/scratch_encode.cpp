// Encodes a bake into memory.
#include "analysis/scratch_encode.h"

#include "analysis/bake_file.h"

#include <limits>

#include "compressor/encode/encode.h"

namespace paim {

Asset encode_in_memory(const BakeReader& bake, EncodeOptions options,
                       const std::filesystem::path& directory) {
    struct Remover {
        std::filesystem::path path;
        ~Remover() {
            std::error_code ignored;
            std::filesystem::remove(path, ignored);
        }
    };
    const Remover file{directory / "scratch.paim.tmp"};
    options.name = bake.directory().stem().string();
    options.memory_bytes = std::numeric_limits<uint64_t>::max();
    encode(bake, options, file.path);
    return read_file_of(bake, file.path);
}

}  // namespace paim
