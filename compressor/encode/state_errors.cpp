// Makes a .paim say how far it is from its bake.
#include "compressor/encode/state_errors.h"

#include <nlohmann/json.hpp>

#include "paim/base/error.h"
#include "paim/format/paim_file.h"

namespace paim {

ModelError state_errors(const std::filesystem::path& file, const BakeReader& bake,
                        const LightSpectrum& spectrum, uint64_t memory_bytes) {
    // Half floats are floats in memory, and what is read is in memory beside what is made of it. Of
    // a plane: the bake, its noise, what was decoded, and as much while it is decoded; measuring takes
    // doubles, a few rows at a time.
    const uint64_t plane_bytes =
        sizeof(float) * uint64_t{bake.identity().num_vertices} * bake.num_poses();
    const uint64_t needed = 3 * std::filesystem::file_size(file) + 6 * plane_bytes;
    if (needed > memory_bytes) {
        throw_unsupported("{}: {} MB are needed to measure it, but --memory allows {}",
                          file.string(), needed / 1'000'000 + 1, memory_bytes / 1'000'000);
    }
    Model model = read_paim(file);
    const ModelError error = measure_model(model, bake, spectrum);
    auto provenance = nlohmann::ordered_json::parse(model.provenance_json);
    provenance["measured"] = nlohmann::ordered_json::parse(error_statement_json(error, spectrum));
    model.provenance_json = provenance.dump();
    write_paim(file, model);
    return error;
}

}  // namespace paim
