// Embeds Paim: reads a .paim file, or a prefix of one, plays the middle of it under light of
// radiance 1 from everywhere, and prints what its vertices show. Where no other part of the mesh is
// in the way, that is the albedo.
#include <cmath>
#include <cstdio>
#include <cstring>
#include <memory>

#include "paim/base/error.h"
#include "paim/codec/playback.h"
#include "paim/format/paim/paim_read.h"
#include "paim/paim.h"

namespace {

void play(const char* file, bool prefix) {
    const auto asset =
        std::make_shared<const paim::Asset>(paim::read_paim(file, {.prefix = prefix}));
    paim::Playback playback(asset);
    // Radiance 1 from everywhere is y_00 alone: L_00 = ∫ y_00 dω = sqrt(4π).
    const auto l00 = static_cast<float>(std::sqrt(4.0 * paim::kPi));
    playback.set_light(paim::DistantLight({1, {paim::Vec3f::Constant(l00)}}));
    playback.update(0.5 * (asset->num_poses() - 1));

    paim::Vec3f lowest = playback.radiance().front(), highest = lowest;
    for (const paim::Vec3f& value : playback.radiance()) {
        lowest = lowest.cwiseMin(value);
        highest = highest.cwiseMax(value);
    }
    double sum = 0.0;
    for (const float x : playback.positions()) sum += double{x};
    std::printf("paim %s: %zu vertices, %u poses, %u bands\n", paim_version(),
                playback.radiance().size(), asset->num_poses(), asset->moving().layout.in_bands);
    std::printf("radiance %.4f %.4f %.4f to %.4f %.4f %.4f\n", lowest.x(), lowest.y(), lowest.z(),
                highest.x(), highest.y(), highest.z());
    std::printf("positions sum to %.4f\n", sum);
}

}  // namespace

int main(int argc, char** argv) {
    const bool prefix = argc == 3 && std::strcmp(argv[1], "--prefix") == 0;
    if (argc != 2 && !prefix) {
        std::fprintf(stderr, "usage: paim_play_cpp [--prefix] X.paim\n");
        return 1;
    }
    try {
        play(argv[argc - 1], prefix);
    } catch (const paim::Error& error) {
        std::fprintf(stderr, "%s\n", error.what());
        return static_cast<int>(error.code());
    }
}
