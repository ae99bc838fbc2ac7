// How a bake gets the noise that an error allows.
#pragma once

#include <string>

#include "paim/format/bake/bake_directory.h"
#include "paim/metrics/transfer_error.h"

namespace paim {

// Which options of the bake should make its noise small enough for this error, by the power law of
// noise over rays: more --rays, or a smaller --noise-target where the bake has one.
// best            the smallest error that a file of this bake can have
// transfer_error  above best.missing_bands and at most best.total()
std::string less_noise_hint(const BakeIdentity& identity, const TransferError& best,
                            double transfer_error);

}  // namespace paim
