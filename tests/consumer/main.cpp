// Embeds Paim: reads a .paim file, decodes a pose, lights it evenly with radiance 1 and prints what
// its vertices show. Where no other part of the mesh is in the way, that is the albedo.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <vector>

#include "paim/base/error.h"
#include "paim/base/version.h"
#include "paim/codec/mesh_decoder.h"
#include "paim/format/paim/paim_read.h"
#include "paim/format/paim/paim_write.h"
#include "paim/shade/shade.h"

int main(int argc, char** argv) {
    if (argc != 2) {
        std::fprintf(stderr, "usage: paim_consumer X.paim\n");
        return 1;
    }
    try {
        const paim::Model model = paim::read_paim(argv[1]);
        const paim::SvdDecoder decoder(model);
        paim::DecodedPose pose;  // keeps its memory from one frame to the next
        decoder.decode(0.5 * (decoder.num_poses() - 1), {}, pose);  // the middle of the animation

        // Radiance 1 from everywhere is y_00 alone: L_00 = ∫ y_00 dω = sqrt(4π).
        const float l00 = static_cast<float>(std::sqrt(4.0 * paim::kPi));
        const paim::LightCoefficients light{1, {paim::Vec3f::Constant(l00)}};
        std::vector<paim::Vec3f> radiance;
        paim::shade(pose.layout, pose.transfer, model.moving().albedo, light, radiance);

        paim::Vec3f lowest = radiance.front(), highest = radiance.front();
        for (const paim::Vec3f& value : radiance) {
            lowest = lowest.cwiseMin(value);
            highest = highest.cwiseMax(value);
        }
        std::printf("paim %s: %zu vertices, %u poses, %u bands\n", paim::kVersion, radiance.size(),
                    model.num_poses(), pose.layout.in_bands);
        std::printf("radiance %.4f %.4f %.4f to %.4f %.4f %.4f\n", lowest.x(), lowest.y(),
                    lowest.z(), highest.x(), highest.y(), highest.z());
    } catch (const paim::Error& error) {
        std::fprintf(stderr, "%s\n", error.what());
        return static_cast<int>(error.code());
    }
}
