// Planes of the transfer and the bands they belong to.
#include "paim/transfer/layout.h"

#include <gtest/gtest.h>

namespace paim {
namespace {

// Band l has the coefficients l² … (l + 1)² − 1, in every channel.
TEST(TransferLayout, PlanesAreOfTheBandOfTheirCoefficient) {
    for (const uint32_t channels : {1u, 3u}) {
        const TransferLayout layout{TransferKind::diffuse, 5, channels};
        for (uint32_t channel = 0; channel < channels; ++channel) {
            for (uint32_t l = 0; l < 5; ++l) {
                for (uint32_t i = l * l; i < (l + 1) * (l + 1); ++i) {
                    EXPECT_EQ(layout.input_band(layout.plane(channel, i)), l);
                }
            }
        }
    }
}

}  // namespace
}  // namespace paim
