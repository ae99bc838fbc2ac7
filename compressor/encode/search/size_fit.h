// The smallest error whose file is not larger than a size.
#pragma once

#include "compressor/encode/search/encoded_file.h"

namespace paim {

// Follows the size over the error, as a power law, to 2 % of the error. Sizes scatter about that
// law, those of small files most: of 1,000 vertices, files of errors 3 to 9 % smaller fitted as
// well.
// Errors: threshold exceeded, with the smallest file there is.
EncodedFile fit_size(const EncodeProblem& problem, EncodedFiles& files, uint64_t most_bytes);

}  // namespace paim
