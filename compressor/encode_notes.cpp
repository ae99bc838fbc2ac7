// What paim-compress says on stderr about an encoding, where a person may not expect its result.
#include "compressor/encode_notes.h"

#include <fmt/format.h>

#include <algorithm>
#include <vector>

#include "compressor/gloss_plan.h"

namespace paim {

// Nothing can be said about errors of transfer that is zero.
void say_if_dark(const BakeReader& reader) {
    const std::vector<double> rms = reader.total_statistics().transfer_rms;
    if (std::any_of(rms.begin(), rms.end(), [](double value) { return value > 0.0; })) return;
    fmt::print(stderr,
               "note: no light reaches any vertex: errors of the transfer are 0 and mean nothing "
               "(where faces look inwards, bake again with --orient into another .bake)\n");
}

void say_if_fewer_bands(const EncodeOptions& asked, const BakeReader& reader) {
    const uint32_t bands = reader.identity().layout.in_bands;
    if (asked.bands <= bands || asked.bands == EncodeOptions().bands) return;
    fmt::print(stderr, "note: --bands {}: the bake has {}, which are all kept\n", asked.bands,
               bands);
}

void say_more_rays_help() {
    fmt::print(stderr,
               "note: most of the error is bake noise: more rays would help more than more "
               "components (bake again with more --rays, into another .bake)\n");
}

void say_gloss_error_is_unused(const char* why) {
    fmt::print(stderr, "note: --max-gloss-error is not used: {}\n", why);
}

void say_if_without_gloss(bool asks_for_gloss, const BakeReader& reader) {
    const bool still_meshes_have_gloss = reader.identity().gloss.has_value();
    if (asks_for_gloss) {
        say_gloss_error_is_unused(still_meshes_have_gloss ? "no vertex of the poses is glossy"
                                                          : "the bake has no gloss");
    }
    if (!still_meshes_have_gloss) return;
    fmt::print(stderr,
               "note: no vertex of the poses is glossy, and the gloss of still meshes alone is not "
               "encoded (bake again {}, into another .bake)\n",
               how_to_keep_still_gloss());
}

}  // namespace paim
