// How a bake gets the noise that an error allows.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "paim/base/error.h"
#include "paim/format/bake/bake_directory.h"
#include "paim/metrics/transfer_error.h"

namespace paim {

// Noise is in the way of a target: a bake of the same sequence with more rays should meet it.
class TooNoisy : public Error {
  public:
    // rays  how many should do
    TooNoisy(const std::string& message, uint32_t rays)
        : Error(ExitCode::threshold_exceeded, message), rays_(rays) {}
    uint32_t rays() const { return rays_; }

  private:
    uint32_t rays_;
};

// How many rays a vertex a bake needs for this error, by the power law of noise over rays; an
// even number. Nothing: more than kMostRays, or the bake has a noise target.
// best            the smallest error that a file of this bake can have
// transfer_error  above best.missing_bands
std::optional<uint32_t> rays_for(const BakeIdentity& identity, const TransferError& best,
                                 double transfer_error);

// Which options of the bake should make its noise small enough for this error: more --rays, or a
// smaller --noise-target where the bake has one.
// transfer_error  above best.missing_bands and at most best.total()
std::string less_noise_hint(const BakeIdentity& identity, const TransferError& best,
                            double transfer_error);

}  // namespace paim
