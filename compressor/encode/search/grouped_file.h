// Files of a given number of groups of vertices, for error curves over this number.
#pragma once

#include <cstdint>
#include <filesystem>

#include "compressor/encode/search/quantise_still.h"
#include "compressor/encode/search/search_memo.h"

namespace paim {

// The file whose transfer is that of type.code_groups(), and whose positions and still meshes meet the
// target.
// type     with code_groups
// Writes all or nothing. Errors: unsupported if there is not enough memory; threshold exceeded if the
// positions cannot meet the target; output failed.
void write_grouped_file(const EncodeProblem& problem, const EncodeOptions& options,
                        const EncodeTarget& target, const TransferEncoderType& type,
                        uint32_t num_groups, SearchMemo& memo, const std::filesystem::path& output);

}  // namespace paim
