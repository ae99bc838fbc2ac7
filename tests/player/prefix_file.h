// A file of which longer and longer prefixes are written.
#pragma once

#include <filesystem>
#include <fstream>
#include <vector>

#include "paim/base/file.h"
#include "paim/codec/asset.h"
#include "paim/format/paim/paim_read.h"
#include "paim/format/paim/paim_write.h"
#include "paim/format/paim/prefixes.h"

namespace paim::player {

class PrefixFile {
  public:
    // Will write the .paim of the asset to `path`, where there is nothing yet. The whole file is at
    // `path`.whole.
    PrefixFile(const std::filesystem::path& path, const Asset& asset) : path_(path) {
        const std::filesystem::path whole = path.string() + ".whole";
        write_paim(whole, asset);
        bytes = read_file(whole, uint64_t{1} << 30);
        prefixes = read_prefixes(whole);
    }

    // Appends to the file until it has this size.
    void write_up_to(uint64_t size_bytes) {
        std::ofstream file(path_, std::ios::binary | std::ios::app);
        file.write(bytes.data() + written_, static_cast<std::streamsize>(size_bytes - written_));
        written_ = size_bytes;
    }

    std::vector<char> bytes;  // that are written from now on
    std::vector<Prefix> prefixes;

  private:
    std::filesystem::path path_;
    uint64_t written_ = 0;
};

}  // namespace paim::player
