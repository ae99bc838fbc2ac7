// The closed form of 2 ∫₀¹ P_l(z) z dz.
// Based on: Ramamoorthi and Hanrahan, On the Relationship between Radiance and Irradiance, 2001
#include "paim/sh/cosine_lobe.h"

#include "paim/base/check.h"
#include "paim/sh/index.h"

namespace paim::sh {

double cosine_lobe(int l) {
    PAIM_CHECK(0 <= l && l < kMaxBands);
    if (l == 1) return 2.0 / 3.0;
    if (l % 2 == 1) return 0.0;
    // 2 (−1)^(l/2−1) / ((l+2)(l−1)) · l! / (2^(l/2) (l/2)!)², the factorials as (1·3·5…)/(2·4·6…);
    // l = 0 gives 1.
    double ratio = (l / 2) % 2 == 1 ? 2.0 : -2.0;
    for (int k = 2; k <= l; k += 2) ratio *= static_cast<double>(k - 1) / k;
    return ratio / (static_cast<double>(l + 2) * (l - 1));
}

}  // namespace paim::sh
