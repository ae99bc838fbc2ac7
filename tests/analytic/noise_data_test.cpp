// What the bake promises of its noise, on a real mesh.
#include <gtest/gtest.h>

#include "compressor/io/obj_files.h"
#include "compressor/io/obj_sequence.h"
#include "tests/analytic/bias.h"

namespace paim {
namespace {

TEST(BakeNoise, IsUnbiasedOnAHorse) {
    const ObjSequence horse(
        find_obj_files({PAIM_UNPACKED_DATA_DIR "/horse-gallop/horse-gallop"}, false));
    const double z = largest_z(horse, SamplerKind::cosine, 64, 4);
    RecordProperty("largest_z", std::to_string(z));
    EXPECT_LT(z, kLargestZ);
}

}  // namespace
}  // namespace paim
