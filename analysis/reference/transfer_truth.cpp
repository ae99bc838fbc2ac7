// The transfer of a bake's poses, baked again with many more rays.
#include "analysis/reference/transfer_truth.h"

#include <algorithm>

#include "analysis/reference/baked_poses.h"

namespace paim {

namespace {

// Another one than people give, so that the truth shares no noise with the bake.
constexpr uint64_t kTruthSeed = 0x7a7e;

BakeOptions truth_options(const BakeIdentity& identity) {
    BakeOptions options = options_of(identity);
    options.rays =
        std::min(kMostTruthRays, kTruthRaysByRays * std::min(identity.rays, kMostTruthRays));
    options.seed += kTruthSeed;
    return options;
}

}  // namespace

TransferTruth::TransferTruth(const BakeReader& bake)
    : RebakedTransfer(bake, truth_options(bake.identity())) {}

}  // namespace paim
