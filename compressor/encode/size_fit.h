// The smallest error whose file is not larger than a size.
#pragma once

#include <functional>

#include "compressor/encode/target_file.h"

namespace paim {

// Resolves the error to 2 %: no file of an error that much smaller is expected to fit, as sizes go.
// say  is told each error that is tried
// Errors: threshold exceeded, with the smallest file there is.
TargetFile fit_size(const Material& material, TargetFiles& files, uint64_t most_bytes,
                    const std::function<void(const char*)>& say);

}  // namespace paim
