// Links Paim's tools: bakes two poses of a tetrahedron from memory and encodes them to an error, without
// the command line.
#include <cstdio>
#include <filesystem>
#include <vector>

#include "compressor/bake/bake_sequence.h"
#include "compressor/encode/search/target_encode.h"
#include "paim/base/error.h"
#include "paim/base/tbb_parallel.h"
#include "paim/mesh/pose_set.h"

namespace {

void bake_and_encode(const std::filesystem::path& bake, const std::filesystem::path& file) {
    const paim::Topology topology{4, {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}}};
    const std::vector<paim::Vec3f> small{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
    std::vector<paim::Vec3f> tall = small;
    tall[3].z() = 2.0f;
    const paim::PoseSet poses(topology, {small, tall}, {{paim::Vec3f(0.5f, 0.25f, 0.75f)}});

    paim::BakeOptions bake_options;
    bake_options.bands = 3;
    bake_options.rays = 64;
    paim::bake_sequence(poses, bake_options, "faces", bake, 0, poses.num_poses() - 1,
                        [](uint32_t) {});
    const paim::BakeReader reader(bake);
    reader.verify_all();
    paim::EncodeTarget target;
    target.transfer_error = 0.05;
    target.spectrum = paim::BandPower::flat(bake_options.bands);
    paim::EncodeOptions options;
    options.precision = paim::Precision::i16;
    const paim::TargetSummary summary = paim::encode_to_target(reader, options, target, file);
    std::printf("%u poses of %u vertices: transfer error %.2f %%\n", summary.num_poses,
                summary.num_vertices, 100.0 * summary.error.transfer.total());
}

}  // namespace

int main(int argc, char** argv) {
    if (argc != 3) {
        std::fprintf(stderr, "usage: paim_bake X.bake X.paim\n");
        return 1;
    }
    paim::use_tbb();  // else everything runs on this thread alone
    try {
        bake_and_encode(argv[1], argv[2]);
    } catch (const paim::Error& error) {
        std::fprintf(stderr, "%s\n", error.what());
        return static_cast<int>(error.code());
    }
}
